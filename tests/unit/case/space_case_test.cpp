// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Cases in space: what they may say, what is refused, and what the programs of the run receive.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "coupler/keys/key_value.hpp"
#include "coupler/protocol/run_values.hpp"
#include "coupler/protocol/scene/prescribed_motion.hpp"
#include "coupler/protocol/scene/sides.hpp"
#include "launcher/case/forecast/disk_cost.hpp"
#include "launcher/case/forecast/mesh_cost.hpp"
#include "launcher/case/forecast/run_cost.hpp"
#include "launcher/case/grains/packing/neighbour_grid.hpp"
#include "launcher/case/grains/packing/pouring.hpp"
#include "launcher/case/grains/packing/space_lattice.hpp"
#include "launcher/case/grains/packing/space_packing.hpp"
#include "launcher/case/grains/population.hpp"
#include "launcher/case/keys/transport_schemes.hpp"
#include "tests/unit/case/case_test.hpp"

namespace turbidite {
namespace {

class SpaceCase : public CaseTest {
 protected:
    SpaceCase()
        : CaseTest(R"(
dimension: 3
domain: {size: [12, 10, 6], front: cyclic, back: cyclic}
grains: {adapter: standalone-nscd, count: 100}
fluid: {enabled: false}
time: {step: 0.01, end: 1}
)") {}
};

class PlaneCase : public CaseTest {
 protected:
    PlaneCase()
        : CaseTest(R"(
domain: {size: [12, 10]}
grains: {adapter: standalone-nscd, count: 10}
fluid: {enabled: false}
time: {step: 0.01, end: 1}
)") {}
};

TEST_F(SpaceCase, TellsThePrograms) {
    const ResolvedCase resolved = load();
    const Settings& s = resolved.settings;
    EXPECT_EQ(s.integer("run.dimension"), 3);
    EXPECT_EQ(s.real("run.size_z"), 6.0);
    EXPECT_EQ(s.real("run.acceleration_z"), 0.0);
    EXPECT_DOUBLE_EQ(s.real("run.grain_weight"), 1.5 * std::numbers::pi / 6.0);
    ASSERT_EQ(resolved.shapes.size(), 1u);
    EXPECT_EQ(resolved.shapes[0].kind, "sphere");
    const RunValues run = run_values(s);
    EXPECT_EQ(run.dimension, 3);
    EXPECT_EQ(run.size, (Vec3{12.0, 10.0, 6.0}));
    EXPECT_EQ(run.period, (Vec3{0.0, 0.0, 6.0}));
    EXPECT_EQ(side_types(s)[4], "cyclic");
    ASSERT_EQ(resolved.population.size(), 100u);
    const auto deepest = std::max_element(
        resolved.population.begin(), resolved.population.end(),
        [](const auto& a, const auto& b) { return a.position[2] < b.position[2]; });
    EXPECT_GT(deepest->position[2], 3.0);
}

TEST_F(SpaceCase, MaterialsHaveTorsionThatTheRunFolderKeeps) {
    const std::string yaml = load("", {"contact.materials.steel.torsion_friction=0.125"}).yaml;
    EXPECT_SAYS(yaml, "materials.steel.torsion_friction: 0.125");
}

TEST_F(SpaceCase, NullStandsForNothingOnlyWhereThereIsNoDefault) {
    EXPECT_SAYS(refusal("", {"grains.lattice=~"}), "grains.lattice has no value");
    EXPECT_SAYS(refusal("", {"contact.film_cutoff=~"}), "contact.film_cutoff has no value");
    EXPECT_FALSE(load("", {"grains.pour_friction=~"}).settings.has("grains.pour_friction"));
}

TEST_F(PlaneCase, ThePlaneSendsNothingOfSpace) {
    const ResolvedCase plane = load();
    const Settings& s = plane.settings;
    for (const char* key :
         {"run.dimension", "run.acceleration_z", "domain.front", "domain.back", "grains.lattice"})
        EXPECT_FALSE(s.has(key)) << key;
    EXPECT_EQ(s.real("run.size_z"), 1.0);
    for (const char* word : {"front", "back", "fcc"})
        EXPECT_EQ(plane.yaml.find(word), std::string::npos) << word;
    EXPECT_EQ(run_values(s).size[2], 0.0);
}

TEST_F(PlaneCase, WhatIsOfSpaceIsRefused) {
    EXPECT_SAYS(refusal("", {"grains.shape=sphere"}), "A sphere is a grain of space.");
    EXPECT_SAYS(refusal("", {"domain.front=cyclic"}), "This key exists with dimension: 3 only.");
    EXPECT_SAYS(refusal("", {"grains.lattice=fcc"}), "This key exists with dimension: 3 only.");
    EXPECT_SAYS(refusal("", {"fluid.surface_shift=0.3"}),
                "This key exists with dimension: 3 only.");
    EXPECT_SAYS(refusal("", {"domain.size=[12, 10, 6]"}), "Width and height of the box");
}

// All at once, each in words.
TEST_F(SpaceCase, WhatSpaceCannotDoIsRefusedAtOnce) {
    folder.write("w.csv", "id,x1,y1,x2,y2\n0,1,1,2,2\n");
    const std::string text = refusal(
        "", {"fluid.enabled=true", "fluid.reynolds=10", "grains.shape=disc",
             "domain.walls_file=w.csv", "contact.solver=central-path", "domain.size=[12, 10]"});
    EXPECT_SAYS(text, "In space grains are spheres in this version.");
    EXPECT_SAYS(text, "In space the first line must read id,kind,x,y,z");
    EXPECT_SAYS(text, "central-path solves contacts of the plane only.");
    EXPECT_SAYS(text, "In space length, height and depth of the box in D, all above 0.");
}

// Signorini and Coulomb only.
TEST_F(SpaceCase, FilesOfContactProblemsDoNotHoldEverything) {
    EXPECT_EQ(refusal("", {"contact.dump_interval=1"}), "");
    EXPECT_SAYS(refusal("", {"contact.dump_interval=1", "contact.torsion_friction=0.1"}),
                "do not support torsional resistance, but contact.torsion_friction = 0.1.");
    EXPECT_SAYS(refusal("", {"contact.dump_interval=1", "contact.rolling_friction=0.1"}),
                "do not support rolling resistance, but contact.rolling_friction = 0.1.");
    const std::string steel = "contact.materials.steel.";
    EXPECT_EQ(refusal("", {"contact.dump_interval=1", steel + "rolling_friction=0"}), "");
    for (const char* name : {"rolling_friction", "torsion_friction"})
        EXPECT_SAYS(refusal("", {"contact.dump_interval=1", steel + name + "=0.1"}),
                    "resistance, but contact.materials.steel." + std::string(name) + " = 0.1.");
    EXPECT_SAYS(
        refusal("", {"contact.dump_interval=1", "contact.film=lubrication", "fluid.enabled=true",
                     "fluid.reynolds=10", "fluid.cells_per_diameter=8"}),
        "do not support films, but contact.film = lubrication.");
}

// What a fluid in the plane can do and one in space cannot.
TEST_F(SpaceCase, AFluidInSpaceSaysWhatItCannotDo) {
    const std::vector<std::string> wet = {"fluid.enabled=true", "fluid.reynolds=10",
                                          "fluid.cells_per_diameter=8"};
    EXPECT_EQ(refusal("", wet), "");
    EXPECT_SAYS(
        refusal("", {"fluid.enabled=true", "fluid.reynolds=10", "fluid.cells_per_diameter=5"}),
        "at least 6 cells wide");
    const auto with = [&](const std::vector<std::string>& more) {
        std::vector<std::string> all = wet;
        all.insert(all.end(), more.begin(), more.end());
        return refusal("", all);
    };
    const std::string text = with({"fluid.points=interior+boundary", "fluid.pressure_solver=PCG",
                                   "fluid.decomposition=columns", "output.probes=[1, 1]",
                                   "domain.top=inflow", "domain.top_profile=parabolic"});
    EXPECT_SAYS(text, "In space there are no points on surfaces in this version.");
    EXPECT_SAYS(text, "In space the fluid is solved on rows of its box only.");
    EXPECT_SAYS(text, "In space every rank has whole layers of cells of one y.");
    EXPECT_SAYS(text, "A list of numbers, three for each point.");
    EXPECT_SAYS(text, "the motion that domain.top_motion names");
    EXPECT_SAYS(text, "velocity: [1, 0, 0]");
    EXPECT_SAYS(text, "In space the fluid enters uniformly");
    EXPECT_SAYS(with({"domain.size=[12, 10, 6.1]"}), "6.1 D are 48.8 cells");
    EXPECT_SAYS(with({"output.probes=[1, 1, 1, 1, 1, 7]"}), "Point 2 is outside the box");
    EXPECT_EQ(with({"output.fields=vorticity solid"}), "");
    EXPECT_SAYS(with({"fluid.surface_shift=1.5"}), "fluid.surface_shift = 1.5");
    // Without the fluid's responses, R_h/R = 1 + 0.6/8: the effective mass is positive from 1.24
    // on, the effective inertia from 1.44.
    EXPECT_SAYS(with({"coupling.scheme=split", "grains.density_ratio=1.4"}), "a ratio above 1.43");
    // Of the smallest: R = 0.4 D.
    EXPECT_SAYS(
        with({"coupling.scheme=split", "grains.density_ratio=1.5", "grains.size_ratio=1.5"}),
        "a ratio above 1.5");
    EXPECT_EQ(with({"coupling.scheme=joint", "grains.density_ratio=1.2"}), "");
}

// 1/(1 + cM R^2/cI) with cM = 1 - 1.075^3/1.5 and cI = 1 - 1.075^5/1.5, of spheres of eight cells.
TEST_F(SpaceCase, TangentialSpringsAreThoseOfWhatMovesInTheLiquid) {
    const auto share = [this](std::vector<std::string> keys) {
        keys.insert(keys.end(),
                    {"grains.adapter=standalone-md", "coupling.scheme=split", "fluid.reynolds=10",
                     "fluid.cells_per_diameter=8", "fluid.splitting=marchuk-yanenko"});
        return load("", keys).settings.real("run.md_tangential_share");
    };
    EXPECT_EQ(share({}), 2.0 / 7.0);
    EXPECT_NEAR(share({"fluid.enabled=true", "grains.density_ratio=1.5"}), 0.0908, 1e-4);
    EXPECT_EQ(share({"fluid.enabled=true", "fluid.surface_shift=0"}), 2.0 / 7.0);
    EXPECT_EQ(
        share({"fluid.enabled=true", "fluid.surface_shift=0", "fluid.hydrodynamic_radius=0.9"}),
        2.0 / 7.0);
}

// What the cells hold is up to a tenth less than what the sphere displaces.
TEST_F(SpaceCase, ALightSphereIsHeavierThanItsCellsMayLack) {
    const auto said = [this](const std::string& density, const std::string& cells,
                             const std::string& shift = "0.3") {
        return refusal("",
                       {"fluid.enabled=true", "fluid.reynolds=10", "coupling.scheme=joint",
                        "fluid.splitting=explicit-multiplier", "fluid.cells_per_diameter=" + cells,
                        "fluid.surface_shift=" + shift, "grains.density_ratio=" + density});
    };
    EXPECT_SAYS(said("0.2", "8"), "density = 0.2");
    EXPECT_SAYS(said("0.2", "8"), "a density above 15/c^2 with c cells across");
    EXPECT_EQ(said("0.24", "8"), "");
    EXPECT_EQ(said("0.2", "10"), "");
    // Neighbours that touch take more of a surface that is shifted more.
    EXPECT_SAYS(said("1.5", "8", "1"), "with fluid.surface_shift s beyond 0.3 above");
    EXPECT_EQ(said("1.8", "8", "1"), "");
    EXPECT_SAYS(said("0.4", "8", "0.5"), "density = 0.4");
    EXPECT_EQ(said("0.6", "8", "0.5"), "");
}

TEST_F(SpaceCase, TheFluidSeesASphereOfSomeCells) {
    const auto said = [this](const std::string& radius) {
        return refusal("", {"fluid.enabled=true", "fluid.reynolds=10", "fluid.cells_per_diameter=8",
                            "fluid.hydrodynamic_radius=" + radius});
    };
    EXPECT_SAYS(said("0.01"), "the fluid sees a diameter of 0.68 cells");
    EXPECT_SAYS(said("0.48"), "a grain is at least 4.5 cells wide");
    EXPECT_EQ(said("0.49"), "");  // 8 (0.49 + 0.3/4) = 4.52
}

TEST_F(SpaceCase, MultipliersInClosedFormHaveNoTolerance) {
    const auto notes = [this](std::vector<std::string> keys) {
        std::string all;
        keys.insert(keys.end(),
                    {"fluid.enabled=true", "fluid.reynolds=10", "fluid.cells_per_diameter=8"});
        for (const std::string& note : load("", keys).notes) all += note + "\n";
        return all;
    };
    EXPECT_SAYS(notes({"fluid.multiplier_tolerance=1e-5"}), "where multipliers are in closed form");
    EXPECT_SAYS(notes({"fluid.multiplier_iterations=7"}), "where multipliers are in closed form");
    EXPECT_EQ(notes({}).find("closed form"), std::string::npos);
}

// As transport_on_rows (fluid_adapter/foam_app/makeFluidStep.cpp) and the box program take them.
TEST_F(SpaceCase, TransportInSpaceIsOnRows) {
    const auto said = [this](const std::string& scheme, const std::string& program) {
        return refusal("", {"fluid.enabled=true", "fluid.reynolds=10", "fluid.cells_per_diameter=8",
                            "fluid.splitting=marchuk-yanenko", "fluid.program=" + program,
                            "fluid.transport_scheme=" + scheme});
    };
    const std::set<std::string> on_rows{"limitedLinearV", "linear", "LUST", "linearUpwind"};
    for (const TransportScheme& scheme : transport_scheme_list()) {
        const bool gradient = scheme.kind == SchemeKind::biased;
        const std::string word = scheme.words == 0 ? "" : gradient ? " grad(U)" : " 1";
        const std::string name = "Gauss " + scheme.name + word;
        for (const char* program : {"openfoam", "box"}) {
            if (on_rows.count(scheme.name) > 0)
                EXPECT_EQ(said(name, program), "") << name;
            else
                EXPECT_SAYS(said(name, program), "In space transport is on rows") << name;
            EXPECT_SAYS(said("bounded " + name, program), "Use Gauss LUST grad(U)") << name;
        }
    }
    const std::string once = said("Gauss vanLeer", "box");
    EXPECT_SAYS(once, "1 error");
    EXPECT_EQ(once.find("fluid.program: openfoam"), std::string::npos) << once;
}

// R = 0.4 D: (1 + 0.3/3.2)^5 = 1.565. grains.density_ratio is enough for spheres of D alone.
TEST_F(SpaceCase, SmallSpheresOfAFileAreAsDenseAsTheFluidSeesThem) {
    folder.write("small.csv", "id,x,y,z,radius\n101,10,9,5,0.4\n");
    const auto said = [this](const std::string& scheme, std::vector<std::string> grains) {
        for (const std::string set :
             {"fluid.enabled=true", "fluid.reynolds=10", "fluid.cells_per_diameter=8",
              "fluid.surface_shift=0.3", "grains.density_ratio=1.5"})
            grains.push_back(set);
        grains.push_back("coupling.scheme=" + scheme);
        return refusal("", grains);
    };
    const std::vector<std::string> alone{"grains.file=small.csv", "grains.count=~"};
    const std::vector<std::string> more{"grains.extra_file=small.csv", "grains.count=1",
                                        "grains.region=[6, 6, 6]"};
    for (const auto& grains : {alone, more}) {
        for (const char* scheme : {"split", "sub-iterated"})
            EXPECT_SAYS(said(scheme, grains), "grain 101: density = 1.5") << scheme;
        EXPECT_EQ(said("joint", grains), "");
    }
}

TEST_F(SpaceCase, FilmsNeedAFluidSpheresAndTheContactEngine) {
    const std::vector<std::string> wet{"fluid.enabled=true", "fluid.reynolds=10",
                                       "fluid.cells_per_diameter=8", "contact.film=lubrication"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), wet.begin(), wet.end());
        return more;
    };
    EXPECT_EQ(refusal("", wet), "");
    const Settings s = load("", wet).settings;
    EXPECT_DOUBLE_EQ(s.real("run.film_cutoff"), 1.2 / 8.0);
    // The default is that of the shift.
    const auto told = [&](const std::vector<std::string>& more) {
        const auto notes = load("", with(more)).notes;
        return std::any_of(notes.begin(), notes.end(), [](const std::string& note) {
            return note.find("without a shift cells resolve films from 2 cells on") !=
                   std::string::npos;
        });
    };
    EXPECT_FALSE(told({"fluid.surface_shift=0.3"}));
    EXPECT_TRUE(told({"fluid.surface_shift=0"}));
    EXPECT_FALSE(told({"fluid.surface_shift=0", "contact.film_cutoff=2"}));
    EXPECT_SAYS(refusal("", with({"grains.adapter=standalone-md"})),
                "standalone-md has no films of liquid between grains");
    EXPECT_SAYS(refusal("", with({"grains.adapter=external", "grains.command=my-code"})),
                "yade-nscd or standalone-nscd");
    EXPECT_SAYS(refusal("", with({"contact.film_cutoff=0.5", "contact.film_roughness=0.07"})),
                "Films act below contact.film_cutoff = 0.5 cells = 0.0625 D");
    EXPECT_SAYS(refusal("", with({"contact.film_cutoff=5"})), "at most 4 cells");
    EXPECT_SAYS(refusal("", with({"contact.film_roughness=0"})),
                "smooth surfaces would never touch");
    EXPECT_SAYS(refusal("", with({"contact.film=stokes"})), "lubrication");
    // On both sides of a box of up to 2 D + 2 1.2/8 D.
    EXPECT_SAYS(refusal("", with({"domain.size=[12, 10, 2.25]", "grains.count=4"})),
                "twice contact.film_cutoff = 0.15 D apart, 2.3 D");
    EXPECT_EQ(refusal("", with({"domain.size=[12, 10, 2.375]", "grains.count=4"})), "");
}

TEST_F(PlaneCase, FilmsAreBetweenDiscsAndSolvedByNlgs) {
    const auto with = [](std::vector<std::string> more) {
        more.insert(more.begin(), {"fluid.enabled=true", "fluid.reynolds=10",
                                   "fluid.cells_per_diameter=8", "contact.film=lubrication"});
        return more;
    };
    EXPECT_EQ(refusal("", with({})), "");
    EXPECT_DOUBLE_EQ(load("", with({})).settings.real("run.film_cutoff"), 1.2 / 8.0);
    EXPECT_FALSE(load("", with({"contact.film=none"})).settings.has("run.film_cutoff"));
    EXPECT_FALSE(load("", with({"fluid.enabled=false"})).settings.has("run.film_cutoff"));
    EXPECT_SAYS(refusal("", with({"grains.shape=triangle"})),
                "Films of liquid are between round grains only, but contact.film = lubrication.");
    EXPECT_SAYS(refusal("", with({"contact.solver=central-path", "contact.iterations=1000000"})),
                "central-path solves contacts without films");
    EXPECT_SAYS(refusal("", with({"contact.dump_interval=1"})), "do not support films");
    EXPECT_SAYS(refusal("", with({"grains.adapter=yade-md", "coupling.scheme=split"})),
                "yade-md has no films of liquid between grains");
    // A polygon among discs, in a file.
    folder.write("g.csv", "id,x,y,shape\n1,2,2,disc\n2,6,6,triangle\n");
    EXPECT_SAYS(refusal("", with({"grains.file=g.csv", "grains.count=~"})),
                "its shape has corners");
}

TEST_F(SpaceCase, SidesOfAFluidSlideAndLetItIn) {
    std::vector<std::string> sets = {"fluid.enabled=true",
                                     "fluid.reynolds=10",
                                     "fluid.cells_per_diameter=8",
                                     "domain.front=wall",
                                     "domain.back=wall",
                                     "domain.motions.m.kind=constant",
                                     "domain.motions.m.velocity=[0.5, 0, -1]",
                                     "domain.top_motion=m"};
    EXPECT_SAYS(load("", sets).settings.text("run.wall_motions"), "3 constant 0.5 0 -1");
    sets.push_back("domain.back_motion=m");
    EXPECT_SAYS(refusal("", sets), "the z component of its motion must be 0");
    sets[4] = "domain.back=inflow";
    EXPECT_SAYS(refusal("", sets), "The box has no free side");
    sets[3] = "domain.front=inflow";
    sets.push_back("domain.front_motion=m");
    const std::string inflows = load("", sets).settings.text("run.inflow_motions");
    EXPECT_SAYS(inflows, "4 constant 0.5 0 -1");
    EXPECT_SAYS(inflows, "5 constant 0.5 0 -1");
}

TEST_F(SpaceCase, SlicesArePlanesInside) {
    const auto with = [](const std::string& slices) {
        return std::vector<std::string>{"fluid.enabled=true", "fluid.reynolds=10",
                                        "fluid.cells_per_diameter=8", "output.slices=" + slices};
    };
    const auto planes = [&](const std::string& slices) {
        const Settings settings = load("", with(slices)).settings;
        return settings.has("run.slices") ? settings.text("run.slices") : "";
    };
    EXPECT_EQ(planes("auto"), "2 3");
    EXPECT_EQ(planes("none"), "");
    EXPECT_EQ(planes("z = 1.5, x=12"), "2 1.5 0 12");
    EXPECT_EQ(planes("y=0 x=3"), "1 0 0 3");
    EXPECT_EQ(planes("y=1e0,x=3"), "1 1 0 3");
    std::string many = "x=3";
    for (int i = 1; i < 20000; ++i) many += ", x=3";
    EXPECT_EQ(planes(many).size(), 20000 * std::string("0 3 ").size() - 1);
    for (const char* text : {"w = 3", "z", "z = ", "3", "z = 1-2", "z = 1; x = 2", "z = 1 x",
                             "z = 1,, x = 2", "z = 1,", "z = 1x = 2"})
        EXPECT_SAYS(refusal("", with(text)), "an axis and a place in D each") << text;
    EXPECT_SAYS(refusal("", with("x = 3, z = 6.5")), "The plane z = 6.5 is outside the box");
    EXPECT_SAYS(refusal("", with("z = -1")), "The plane z = -1 is outside the box");
    EXPECT_FALSE(load().settings.has("run.slices")) << "without a fluid";
    const double none = predicted_disk(load("", with("none")));
    const double cells = 12 * 10 * 64;  // of a plane at D/8; 2 outputs in 1 t_c
    EXPECT_NEAR(predicted_disk(load("", with("auto"))) - none, 2 * cells * 20e-9, 1e-9);
}

TEST_F(SpaceCase, AFluidInSpaceIsForecast) {
    const std::vector<std::string> wet = {"fluid.enabled=true", "fluid.reynolds=10",
                                          "fluid.cells_per_diameter=8"};
    const ResolvedCase space = load("", wet);
    const auto size = real_list("domain.size", space.settings.text("domain.size"));
    EXPECT_DOUBLE_EQ(fluid_cells(space.settings), size[0] * size[1] * size[2] * 512.0);
    EXPECT_GT(forecast_window(space, 64.0).fluid, 80e-9 * fluid_cells(space.settings));
    EXPECT_DOUBLE_EQ(space.settings.real("run.surface_shift"), 0.3 / 8.0);
}

TEST_F(SpaceCase, ExtraGrainsAreAddedToGeneratedOnes) {
    folder.write("ball.csv", "id,x,y,z,radius,vy\n1000,6,8,3,1.5,-2\n");
    const std::vector<std::string> with = {"grains.extra_file=ball.csv",
                                           "grains.region=[12, 6, 6]"};
    const ResolvedCase resolved = load("", with);
    ASSERT_EQ(resolved.population.size(), 101u);
    EXPECT_EQ(resolved.population.back().id, 1000);
    EXPECT_EQ(resolved.population.back().radius, 1.5);
    EXPECT_EQ(resolved.population.back().velocity[1], -2.0);
    EXPECT_SAYS(resolved.grains_csv, "1000,");
    folder.write("ball.csv", "id,x,y,z,radius\n7,6,8,3,1.5\n");
    EXPECT_SAYS(refusal("", with), "7");
    folder.write("ball.csv", "id,x,y,z,radius\n1000,6,8,5,1.5\n1001,6,8,3,1.5\n");
    EXPECT_SAYS(refusal("", with), "overlap");
    EXPECT_SAYS(refusal("", {"grains.extra_file=gone.csv"}), "There is no file");
}

// As of a file that describes all grains.
TEST_F(PlaneCase, ExtraGrainsHaveShapesThatTheirProgramMoves) {
    folder.write("more.csv", "id,x,y,shape\n1000,6,8,triangle\n");
    const std::string extra = "grains.extra_file=more.csv";
    EXPECT_EQ(refusal("", {extra, "grains.adapter=standalone-md"}), "");
    EXPECT_SAYS(refusal("", {extra, "grains.adapter=lammps-md"}),
                "grain 1000: its shape is not supported by lammps-md");
}

TEST_F(SpaceCase, SpringsHaveNoTorsion) {
    EXPECT_EQ(refusal("", {"contact.torsion_friction=0.1"}), "");
    EXPECT_SAYS(refusal("", {"contact.torsion_friction=0.1", "grains.adapter=standalone-md"}),
                "has no resistance to torsion");
}

TEST_F(SpaceCase, TheForecastCountsSpheres) {
    const auto window = [&](const char* count) {
        return forecast_window(load("", {std::string("grains.count=") + count}), 64.0).grains;
    };
    EXPECT_DOUBLE_EQ(window("200"), 2.0 * window("100"));
    EXPECT_DOUBLE_EQ(window("100"), 100 * 8e-6);
    EXPECT_GT(predicted_memory(load("", {"grains.count=200"})), predicted_memory(load()));
    EXPECT_GT(predicted_disk(load("", {"grains.count=200"})), 1.5 * predicted_disk(load()));
}

TEST_F(SpaceCase, ContactsMayResistRollingAndTorsion) {
    const ResolvedCase resolved =
        load("", {"contact.rolling_friction=0.1", "contact.torsion_friction=0.05"});
    EXPECT_EQ(resolved.settings.real("contact.torsion_friction"), 0.05);
}

TEST_F(SpaceCase, PouredGrainsHaveStandInsAndARunOfTheirOwn) {
    const std::vector<std::string> poured = {"grains.generator=poured", "grains.region=[6, 9, 6]",
                                             "grains.pour_friction=0.5", "domain.right=free"};
    const ResolvedCase resolved = load("", poured);
    EXPECT_TRUE(is_poured(resolved.settings));
    EXPECT_EQ(resolved.population.size(), 100u);
    std::vector<std::string> changed = poured;
    for (const std::string& change : pouring_changes(resolved)) changed.push_back(change);
    const ResolvedCase pouring = load("", changed);
    const Settings& s = pouring.settings;
    EXPECT_EQ(s.text("grains.generator"), "random");
    EXPECT_EQ(s.real("contact.friction"), 0.5);
    EXPECT_EQ(s.text("domain.right"), "wall");    // the ground is smaller than the box
    EXPECT_EQ(s.text("domain.front"), "cyclic");  // as deep as the box
    EXPECT_EQ(s.real("run.size_x"), 6.0);
    EXPECT_EQ(pouring.population.size(), 100u);
    // The packing does not depend on who plays the run, so that it is poured once.
    std::vector<std::string> on_ranks = poured;
    on_ranks.insert(on_ranks.end(),
                    {"grains.adapter=standalone-nscd", "grains.ranks=2", "contact.threads=2"});
    const std::vector<std::string> again = pouring_changes(load("", on_ranks));
    on_ranks.insert(on_ranks.end(), again.begin(), again.end());
    EXPECT_EQ(load("", on_ranks).yaml, pouring.yaml);
    std::vector<std::string> full = poured;
    full.push_back("grains.count=500");  // 0.81 of the region
    EXPECT_SAYS(refusal("", full), "poured packings fill 0.66 at most");
}

std::vector<std::string> with(std::vector<std::string> words,
                              const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

// In free fall grains have little energy in units of a large u_c, and windows of a small one are
// long.
TEST_F(SpaceCase, GrainsArePouredInTheScalesOfGravity) {
    const std::vector<std::string> fast = {
        "grains.generator=poured",   "scales.kind=physical",
        "scales.diameter=1e-4",      "scales.gravity=10",
        "scales.fluid_density=1000", "scales.viscosity=1e-6",
        "scales.velocity=1",         "time.step=0.3",
        "contact.restitution=0.5",   "contact.restitution_speed=0.01"};
    const ResolvedCase resolved = load("", fast);
    const ResolvedCase pouring = load("", with(fast, pouring_changes(resolved)));
    EXPECT_EQ(pouring.scales.kind, "avalanche");
    EXPECT_EQ(pouring.settings.real("time.step"), 0.01);
    // 0.01 u_c = 0.01 m/s, and sqrt(g D) = 0.0316 m/s
    EXPECT_NEAR(pouring.settings.real("contact.restitution_speed"), 0.316228, 1e-6);
    const ResolvedCase plain = load("", {"grains.generator=poured", "contact.restitution=0.5",
                                         "contact.restitution_speed=0.316227766016838"});
    EXPECT_EQ(plain.packing.size(), pouring.packing.size());
}

TEST_F(SpaceCase, OneFrictionPoursAllContacts) {
    const std::vector<std::string> given = {"grains.generator=poured",
                                            "grains.pour_friction=0",
                                            "contact.law=static-dynamic",
                                            "contact.friction=0.3",
                                            "contact.static_friction=1",
                                            "contact.materials.steel.friction=0.2",
                                            "domain.material=steel",
                                            "contact.pairs.steel-default.friction=0.4",
                                            "contact.materials.steel.static_friction=0.6"};
    const Settings s = load("", with(given, pouring_changes(load("", given)))).settings;
    EXPECT_EQ(s.text("contact.law"), "coulomb");
    for (const char* key : {"contact.friction", "contact.materials.steel.friction",
                            "contact.pairs.steel-default.friction"})
        EXPECT_EQ(s.real(key), 0.0) << key;
    EXPECT_FALSE(s.has("contact.static_friction"));
    EXPECT_FALSE(s.has("contact.materials.steel.static_friction"));
}

// Spheres of 6 cells fit, whatever the size of what stands in for them.
TEST_F(SpaceCase, StandInsAreNotTakenForTooSmall) {
    const std::vector<std::string> tight = {
        "grains.generator=poured", "grains.count=118",  "grains.region=[3.5, 10, 3.5]",
        "fluid.enabled=true",      "fluid.reynolds=10", "fluid.cells_per_diameter=6",
        "coupling.scheme=joint"};
    const ResolvedCase resolved = load("", tight);
    EXPECT_LT(resolved.packing.front().radius, 0.5);
    EXPECT_SAYS(refusal("", with(tight, {"fluid.cells_per_diameter=5"})), "cells");
}

TEST_F(SpaceCase, HowMuchOfAVelocityTheFluidLeavesIsTold) {
    const auto told = [this](const std::string& csv, const std::string& fluid) {
        folder.write("moving.csv", csv);
        const ResolvedCase resolved = load(
            "", {"grains.file=moving.csv", "grains.density_ratio=1.5", "fluid.reynolds=10",
                 "coupling.scheme=joint", "fluid.cells_per_diameter=8", "fluid.enabled=" + fluid});
        std::string notes;
        for (const std::string& note : resolved.notes) notes += note + "\n";
        return notes;
    };
    const std::string moving = "id,x,y,z,vx,motion\n1,1,2,2,1,free\n2,3,2,2,1,driven\n";
    // 1.5/(1.5 + 0.5 (1 + 0.6/8)^3)
    EXPECT_SAYS(told(moving, "true"), "1 grain(s) begin with a velocity or spin");
    EXPECT_SAYS(told(moving, "true"), "about 0.71 of it stays");
    // Each by its own density.
    EXPECT_SAYS(told("id,x,y,z,vx,density\n1,6,5,3,2,1.5\n2,9,5,3,2,7\n", "true"),
                "about 0.71 to 0.92 of it stays");
    EXPECT_EQ(told(moving, "false").find("begin with"), std::string::npos);
    EXPECT_EQ(told("id,x,y,z\n1,1,2,2\n", "true").find("begin with"), std::string::npos);
}

// A belt would stir the grains for ever, and no place of a stand-in tells whether a wall cuts a
// grain.
TEST_F(SpaceCase, GrainsArePouredWithoutWallsInside) {
    folder.write("walls.csv",
                 "id,kind,x,y,z,ax,ay,az,bx,by,bz,vx,vy,vz\n"
                 "1,plate,0,5,0,3,0,0,0,0,3,1,0,0\n");
    const std::vector<std::string> given = {"grains.generator=poured", "grains.region=[6, 9, 6]",
                                            "domain.walls_file=walls.csv"};
    const ResolvedCase resolved = load("", given);
    EXPECT_FALSE(resolved.walls_csv.empty());
    EXPECT_NE(std::find_if(resolved.notes.begin(), resolved.notes.end(),
                           [](const std::string& note) {
                               return note.find("without the walls") != std::string::npos;
                           }),
              resolved.notes.end());
    EXPECT_TRUE(load("", with(given, pouring_changes(resolved))).walls_csv.empty());
}

TEST_F(SpaceCase, ProbesOutsideTheGroundDoNotPreventPouring) {
    const std::vector<std::string> wet = {"grains.generator=poured",  "grains.region=[6, 9, 6]",
                                          "fluid.enabled=true",       "fluid.reynolds=10",
                                          "coupling.scheme=joint",    "fluid.cells_per_diameter=8",
                                          "output.probes=[11, 1, 1]", "output.slices=x = 11"};
    const ResolvedCase resolved = load("", wet);
    EXPECT_EQ(refusal("", with(wet, pouring_changes(resolved))), "");
}

// Into a shaft that is higher than the equal rows of the fluid's box.
TEST_F(SpaceCase, GrainsOfAFluidArePouredWithoutIt) {
    std::vector<std::string> wet = {"grains.generator=poured",    "grains.region=[6, 9, 6]",
                                    "fluid.enabled=true",         "fluid.reynolds=10",
                                    "fluid.cells_per_diameter=8", "fluid.stretch_ratio=1.05",
                                    "fluid.stretch_from=6",       "coupling.scheme=joint"};
    const ResolvedCase resolved = load("", wet);
    const std::vector<std::string> changes = pouring_changes(resolved);
    wet.insert(wet.end(), changes.begin(), changes.end());
    const ResolvedCase pouring = load("", wet);
    EXPECT_FALSE(pouring.settings.flag("fluid.enabled"));
    EXPECT_GT(pouring.settings.real("run.size_y"), 6.0);
}

// What one rank can play and several cannot is not asked of the pouring.
TEST_F(SpaceCase, SeveralRanksPourWhatOneRankPlays) {
    const std::vector<std::string> poured = {"grains.generator=poured", "grains.region=[6, 9, 6]"};
    for (const std::vector<std::string>& more :
         {std::vector<std::string>{"contact.dump_interval=5", "output.timeline=true"},
          {"grains.adapter=standalone-md", "fluid.enabled=true", "fluid.reynolds=10",
           "fluid.cells_per_diameter=8", "fluid.splitting=marchuk-yanenko",
           "coupling.scheme=sub-iterated"}}) {
        const std::vector<std::string> one = with(poured, more);
        std::vector<std::string> on_two = with(one, pouring_changes(load("", one)));
        on_two.push_back("grains.ranks=2");
        EXPECT_EQ(refusal("", on_two), "");
        EXPECT_FALSE(load("", on_two).settings.flag("output.timeline"));
    }
}

// The fluid sees it beyond its surface: it would refuse its first window.
TEST_F(SpaceCase, ASphereThatTheFluidSeesInStretchedRowsIsRefused) {
    folder.write("g.csv", "id,x,y,z\n7,3,4.5,3\n");
    const std::vector<std::string> wet = {"grains.file=g.csv",          "fluid.enabled=true",
                                          "fluid.reynolds=10",          "fluid.surface_shift=0.3",
                                          "fluid.cells_per_diameter=8", "fluid.stretch_ratio=1.05",
                                          "coupling.scheme=joint",      "fluid.stretch_from=5"};
    EXPECT_SAYS(refusal("", wet), "grain 7: reaches y = 5.037 D");
    std::vector<std::string> bare = wet;
    bare.push_back("fluid.surface_shift=0");
    EXPECT_EQ(refusal("", bare), "");
}

TEST_F(SpaceCase, EveryHostPlaysIt) {
    for (const std::string adapter :
         {"yade-nscd", "standalone-nscd", "yade-md", "lammps-md", "standalone-md"})
        EXPECT_EQ(
            refusal("", {"grains.adapter=" + adapter, "domain.front=wall", "domain.back=wall"}), "")
            << adapter;
    EXPECT_SAYS(refusal("", {"grains.adapter=yade-md"}), "yade-md does not support cyclic sides");
    for (const std::string adapter : {"standalone-md", "lammps-md"})
        EXPECT_EQ(refusal("", {"grains.adapter=" + adapter}), "");
}

// A rule that reads a side whose value was refused would end with "no key".
TEST_F(SpaceCase, AMisspeltSideIsToldWhateverReadsIt) {
    EXPECT_SAYS(
        refusal("", {"fluid.enabled=true", "fluid.reynolds=10", "fluid.cells_per_diameter=8",
                     "fluid.acceleration=[0, 0, 0.1]", "domain.front=periodic"}),
        "domain.front = periodic");
}

TEST_F(SpaceCase, TheFluidNeedsFourCellsAlongEachAxis) {
    folder.write("g.csv", "id,x,y,z\n1,3,3,0.25\n");
    const auto with_depth = [&](const char* depth) {
        return refusal("", {"fluid.enabled=true", "fluid.reynolds=10", "grains.file=g.csv",
                            "fluid.cells_per_diameter=8", "domain.front=free", "domain.back=free",
                            std::string("domain.size=[12, 10, ") + depth + "]"});
    };
    EXPECT_SAYS(with_depth("0.375"), "0.375 D are 3 cells; the mesh needs 4.");
    EXPECT_SAYS(with_depth("0.375"), "Use 0.5 D or more.");
    EXPECT_EQ(with_depth("0.5"), "");
}

TEST_F(SpaceCase, SidesComeInPairsAndRegionsInTheBox) {
    EXPECT_SAYS(refusal("", {"domain.back=wall"}), "Cyclic sides come in pairs");
    EXPECT_SAYS(refusal("", {"domain.front=inflow"}), "Without a fluid nothing enters.");
    EXPECT_SAYS(refusal("", {"grains.region=[12, 10, 7]"}), "The region lies in the box");
    EXPECT_SAYS(refusal("", {"grains.region=[12, 10]"}), "Length, height and depth in D");
    EXPECT_SAYS(refusal("", {"domain.size=[12, 10, 1.5]", "grains.count=4"}),
                "Cyclic sides are more than the two largest grains apart");
}

TEST_F(SpaceCase, DenseRandomPackingsHaveToBePoured) {
    // 720 D^3: 0.45 of it are 618 spheres.
    EXPECT_SAYS(refusal("", {"grains.count=620"}), "Use grains.generator: poured");
    const ResolvedCase dense = load("", {"grains.count=600"});
    EXPECT_EQ(dense.population.size(), 600u);
}

TEST_F(SpaceCase, LatticesHaveTheirLimits) {
    const std::string lattice = "grains.generator=lattice";
    EXPECT_SAYS(refusal("", {lattice, "grains.compacity=0.75"}),
                "The fcc lattice has compacities up to 0.7405");
    EXPECT_SAYS(refusal("", {lattice, "grains.lattice=sc", "grains.compacity=0.6"}),
                "up to 0.5236");
    EXPECT_SAYS(refusal("", {lattice, "grains.lattice=hcp"}), "Available: fcc, bcc, sc.");
    EXPECT_SAYS(refusal("", {lattice, "grains.radius=0.4"}), "spheres of diameter D only");
    EXPECT_DOUBLE_EQ(load("", {lattice}).settings.real("grains.compacity"),
                     std::numbers::pi / 3.0 / std::numbers::sqrt2);
    EXPECT_EQ(load("", {lattice, "grains.lattice=sc"}).population.size(), 12u * 10u * 6u);
}

/// Number density times the volume of a sphere in the middle of a large lattice.
double measured_compacity(const Packing& grains, double length) {
    const double low = 0.25 * length, high = 0.75 * length;
    const auto within = [&](double x) { return x >= low && x < high; };
    const auto inner = std::count_if(grains.begin(), grains.end(), [&](const PlacedGrain& g) {
        return within(g.x) && within(g.y) && within(g.z);
    });
    return static_cast<double>(inner) * std::numbers::pi / 6.0 / std::pow(high - low, 3);
}

double smallest_gap(const Packing& grains, const PackingBox& box) {
    double smallest = INFINITY;
    NeighbourGrid grid(box, largest_radius(grains), 0.1);
    for (const PlacedGrain& grain : grains) {
        for (const std::size_t j : grid.near(grain.x, grain.y, grain.z))
            smallest = std::min(smallest, grid.circle_gap(grain, grid.grains()[j]));
        grid.insert(grain);
    }
    return smallest;
}

TEST(SpaceLattice, HasItsCompacityAndTouchesWhenDensest) {
    const PackingBox box{.width = 40.0, .height = 40.0, .depth = 40.0};
    for (const SpaceLattice& lattice : space_lattices()) {
        for (const double share : {1.0, 0.8}) {
            const double compacity = share * lattice.densest();
            const Packing grains = lattice_sites(lattice, {40.0, 40.0, 40.0}, 0.5, compacity);
            EXPECT_NEAR(measured_compacity(grains, 40.0) / compacity, 1.0, 0.12) << lattice.name;
            EXPECT_NEAR(smallest_gap(grains, box), std::cbrt(1.0 / share) - 1.0, 1e-9)
                << lattice.name;
        }
    }
}

// Of dust there is room for 1e13 grains.
TEST(SpaceLattice, StopsAtTheSitesAskedFor) {
    const Packing grains = lattice_sites(space_lattice("fcc"), {40.0, 40.0, 40.0}, 1e-3, 0.7, 1000);
    EXPECT_EQ(grains.size(), 1000u);
    EXPECT_LT(grains.back().y, 0.01);
}

TEST(RandomSpacePacking, RefusesBillionsBeforeItDrawsThem) {
    const GrainForms forms = plain_spheres();
    const PackingBox box{.width = 8.0, .height = 8.0, .depth = 8.0};
    const PackingRequest request{
        .box = box, .count = 3'000'000'000'000, .forms = &forms, .size_ratio = 1.5};
    EXPECT_SAYS(random_space_packing(request).refusal, "grains.generator: lattice");
    EXPECT_EQ(random_space_packing(request).refusal.find("poured"), std::string::npos);
    EXPECT_SAYS(poured_stand_in(request).refusal, "fewer grains");
}

TEST(SpaceLattice, DoesNotMeetAcrossCyclicSides) {
    const PackingBox box{
        .width = 7.3, .height = 9.0, .periodic_x = true, .depth = 5.1, .periodic_z = true};
    const PackingResult result =
        space_lattice_packing({.box = box, .compacity = 0.7405, .lattice = "fcc"});
    EXPECT_GT(result.grains.size(), 200u);
    EXPECT_GE(smallest_gap(result.grains, box), -1e-9);
}

TEST(RandomSpacePacking, GrainsOfSeveralSizesDoNotOverlap) {
    GrainForms forms = plain_spheres();
    const PackingBox box{.width = 8.0, .height = 8.0, .depth = 8.0, .periodic_z = true};
    for (const std::int64_t count : {150, 330}) {  // 0.15 and 0.34 of the box
        const PackingResult result =
            random_space_packing({.box = box, .count = count, .forms = &forms, .size_ratio = 1.5});
        ASSERT_EQ(result.refusal, "");
        EXPECT_EQ(static_cast<std::int64_t>(result.grains.size()), count);
        EXPECT_GE(smallest_gap(result.grains, box), -1e-9);
        EXPECT_GT(result.grains.front().radius, 1.3 * result.grains.back().radius);
    }
}

TEST(RandomSpacePacking, JitterMovesAlongAllAxes) {
    const PackingBox box{.width = 6.0, .height = 6.0, .depth = 6.0};
    PackingRequest request{.box = box, .compacity = 0.3, .lattice = "sc"};
    const Packing still = space_lattice_packing(request).grains;
    request.jitter = 0.05;
    const Packing moved = space_lattice_packing(request).grains;
    ASSERT_EQ(still.size(), moved.size());
    double x = 0.0, y = 0.0, z = 0.0;
    for (std::size_t i = 0; i < still.size(); ++i) {
        x = std::max(x, std::abs(moved[i].x - still[i].x));
        y = std::max(y, std::abs(moved[i].y - still[i].y));
        z = std::max(z, std::abs(moved[i].z - still[i].z));
    }
    for (const double largest : {x, y, z}) {
        EXPECT_GT(largest, 0.02);
        EXPECT_LE(largest, 0.05);
    }
}

TEST_F(SpaceCase, ReadsGrainsFilesWithZAndRotation) {
    folder.write("g.csv",
                 "id,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz,motion\n"
                 "3,1,1,2,0.6,0.8,0,0,1,2,3,4,5,6,free\n"
                 "4,3,1,2,1,0,0,0,0,0,0,0,0,0,fixed\n");
    const ResolvedCase resolved = load("", {"grains.file=g.csv"});
    const GrainState& grain = resolved.population.at(0);
    EXPECT_EQ(grain.position, (Vec3{1, 1, 2}));
    EXPECT_EQ(grain.orientation, (Quaternion{0.6, 0.8, 0, 0}));
    EXPECT_EQ(grain.velocity, (Vec3{1, 2, 3}));
    EXPECT_EQ(grain.angular_velocity, (Vec3{4, 5, 6}));
    EXPECT_TRUE(resolved.population.at(1).prescribed);
    // A run folder holds the same grains again.
    folder.write("again.csv", resolved.grains_csv);
    const ResolvedCase again = load("", {"grains.file=again.csv"});
    EXPECT_EQ(again.grains_csv, resolved.grains_csv);
    EXPECT_EQ(again.population.at(0).orientation, grain.orientation);
}

TEST_F(SpaceCase, GrainsFilesAreChecked) {
    EXPECT_SAYS(refusal_of_grains("id,x,y\n0,1,1\n"), "In space the first line must read id,x,y,z");
    EXPECT_SAYS(refusal_of_grains("id,x,y,z,angle\n0,1,1,1,0\n"), "angle");
    EXPECT_SAYS(refusal_of_grains("id,x,y,z,qw,qx,qy,qz\n0,1,1,1,1,1,0,0\n"),
                "is no unit quaternion");
    EXPECT_SAYS(refusal_of_grains("id,x,y,z,wx,motion\n0,1,1,1,2,fixed\n"),
                "is fixed and has a velocity");
    EXPECT_SAYS(refusal_of_grains("id,x,y,z\n0,1,1,1\n1,1.5,1,1.5\n"), "overlap by");
    EXPECT_SAYS(refusal_of_grains("id,x,y,z\n0,1,1,0.2\n1,1,1,5.8\n"), "overlap by");
    EXPECT_SAYS(refusal_of_grains("id,x,y,z\n0,1,1,7\n"), "1 D beyond its back side");
    EXPECT_SAYS(refusal_of_grains("id,x,y,z\n0,1,1,7\n"), "The box is 12 x 10 x 6 D.");
}

TEST_F(SpaceCase, WallsMoveInThreeDirections) {
    const ResolvedCase moving =
        load("", {"domain.bottom_motion=slide", "domain.motions.slide.kind=constant",
                  "domain.motions.slide.velocity=[1, 0, 2]"});
    EXPECT_EQ(moving.settings.text("run.wall_motions"), "2 constant 1 0 2 0 0 0");
    const auto walls = motions_of(moving.settings, "run.wall_motions");
    ASSERT_EQ(walls.size(), 1u);
    EXPECT_EQ(walls[0].motion->at(2.0).displacement, (Vec3{2, 0, 4}));
    EXPECT_SAYS(refusal("", {"domain.bottom_motion=slide", "domain.motions.slide.kind=constant",
                             "domain.motions.slide.velocity=[1, 0]"}),
                "A list of three numbers: x, y, z.");
    EXPECT_SAYS(refusal("", {"domain.bottom_motion=slide", "domain.motions.slide.kind=table",
                             "domain.motions.slide.table=[0, 0, 0, 2, 1, 0]"}),
                "Rows of time [t_c], x, y, z [D]");
}

TEST_F(SpaceCase, GrainsTurnAboutAnyAxis) {
    folder.write("g.csv", "id,x,y,z,motion\n7,3,3,3,spin\n");
    const std::vector<std::string> spin = {
        "grains.file=g.csv", "domain.motions.spin.kind=harmonic", "domain.motions.spin.turn=0.5",
        "domain.motions.spin.axis=[0, 0, 2]", "domain.motions.spin.period=4"};
    EXPECT_EQ(load("", spin).settings.text("run.grain_motions"), "7 harmonic 0 0 0 0 0 0.5 4 0");
    std::vector<std::string> nowhere = spin;
    nowhere[3] = "domain.motions.spin.axis=[0, 0, 0]";
    EXPECT_SAYS(refusal("", nowhere), "A direction, of any length but 0.");
}

}  // namespace
}  // namespace turbidite
