// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What a fluid cannot carry: grains too light for the scheme or too small for the mesh, a mesh too
// large for the memory.
#include <gtest/gtest.h>

#include "coupler/keys/limit_text.hpp"
#include "launcher/case/forecast/mesh_cost.hpp"
#include "launcher/case/forecast/transform_length.hpp"
#include "tests/unit/case/case_test.hpp"

namespace turbidite {
namespace {

class FluidLimits : public CaseTest {
 protected:
    FluidLimits()
        : CaseTest(
              "domain: {size: [12, 24]}\n"
              "grains: {count: 20}\n"
              "fluid: {reynolds: 36}\n"
              "time: {step: 0.01, end: 1}\n") {}
};

TEST_F(FluidLimits, LightGrainsInAFluidNeedJoint) {
    EXPECT_EQ(refusal("", {"grains.density_ratio=0.5", "fluid.enabled=false"}), "");
    for (const char* ratio : {"grains.density_ratio=0.5", "grains.density_ratio=1"}) {
        EXPECT_SAYS(refusal("", {ratio, "coupling.scheme=split"}), "Use coupling.scheme: joint");
        EXPECT_SAYS(refusal("", {ratio, "coupling.scheme=split"}), "1 error, nothing was started");
        EXPECT_EQ(refusal("", {ratio, "coupling.scheme=joint"}), "");
    }
    EXPECT_SAYS(refusal("", {"grains.density_ratio=0", "fluid.enabled=false"}),
                "grains.density_ratio = 0");
}

// Step 1 of the paper's splitting takes more from a light grain than step 5 gives it back.
TEST_F(FluidLimits, VeryLightGrainsNeedAPressureThatKnowsThem) {
    const auto said = [this](const char* ratio, const char* grains, const char* splitting,
                             const char* more = "grains.jitter=0") {
        return refusal(
            "", {std::string("grains.density_ratio=") + ratio,
                 std::string("grains.count=") + grains, std::string("fluid.splitting=") + splitting,
                 "coupling.scheme=joint", "fluid.cells_per_diameter=16", more});
    };
    const char* use_another = "Use fluid.splitting: explicit-multiplier";
    EXPECT_SAYS(said("0.4", "20", "marchuk-yanenko"), use_another);
    EXPECT_EQ(said("0.5", "20", "marchuk-yanenko"), "");
    EXPECT_EQ(said("0.2", "20", "explicit-multiplier"), "");
    // By itself a disc has C_a = 1, beside a wall pi^2/3 - 1; a long one more, and so has one that
    // is between images of itself.
    EXPECT_SAYS(said("0.34", "1", "marchuk-yanenko"), "at least 0.36 times");
    EXPECT_EQ(said("0.37", "1", "marchuk-yanenko"), "");
    EXPECT_SAYS(said("0.37", "1", "marchuk-yanenko", "grains.shape=triangle"), use_another);
    EXPECT_SAYS(said("0.37", "1", "marchuk-yanenko", "domain.size=[5, 24]"), use_another);
    // What counts is the fluid that it displaces, (R_h/R)^2 of it.
    EXPECT_EQ(refusal("", {"grains.density_ratio=0.4", "fluid.hydrodynamic_radius=0.85",
                           "fluid.splitting=marchuk-yanenko", "coupling.scheme=joint"}),
              "");
}

// A + T^T G^-1 T of a disc in the plane is positive at all places in the mesh.
TEST_F(FluidLimits, LightGrainsInThePlaneNeedCells) {
    const auto said = [this](const char* ratio, const char* cells, const char* shape) {
        return refusal("", {std::string("grains.density_ratio=") + ratio,
                            std::string("fluid.cells_per_diameter=") + cells,
                            std::string("grains.shape=") + shape, "coupling.scheme=joint",
                            "fluid.splitting=explicit-multiplier"});
    };
    EXPECT_SAYS(said("0.32", "8", "disc"), "density = 0.32, 8 cells across");
    EXPECT_EQ(said("0.34", "8", "disc"), "");
    EXPECT_EQ(said("0.16", "12", "disc"), "");
    EXPECT_EQ(said("0.5", "4", "disc"), "");
    // Of the triangle of 0.75 D: an inscribed circle of 0.75 D
    EXPECT_SAYS(said("0.16", "12", "triangle"), "9 cells across");
    EXPECT_EQ(said("0.27", "12", "triangle"), "");
}

TEST_F(FluidLimits, PolygonsAreThickerThanTheirSurfaces) {
    const auto said = [this](const char* vertices, const char* ratio, const char* points) {
        return refusal(
            "", {std::string("grains.vertices=") + vertices, "grains.shape=polygon",
                 std::string("grains.density_ratio=") + ratio, "coupling.scheme=joint",
                 std::string("fluid.points=") + points, "fluid.cells_per_diameter=8",
                 "grains.radius=1", "grains.count=3", "fluid.splitting=explicit-multiplier"});
    };
    const char* plate = "[0, 0, 2, 0, 2, 0.2, 0, 0.2]";  // 1.6 cells
    const char* thick = "[0, 0, 2, 0, 2, 0.3, 0, 0.3]";  // 2.4 cells, 4.15 across
    EXPECT_SAYS(said(plate, "1.5", "interior"), "cells thick as the fluid sees it");
    EXPECT_EQ(said(thick, "1.5", "interior+boundary"), "");
    // One of the fluid's density has the inertia of its inner cells alone.
    EXPECT_SAYS(said(thick, "1", "interior+boundary"), "at least 4.4 cells across");
    EXPECT_EQ(said(thick, "1", "interior"), "");
    EXPECT_EQ(said(thick, "1.01", "interior+boundary"), "");
    EXPECT_EQ(said("[0, 0, 2, 0, 2, 0.4, 0, 0.4]", "1", "interior+boundary"), "");
}

/// What a text says between two of its parts.
std::string between(const std::string& text, const std::string& before, const std::string& after) {
    const std::size_t begin = text.find(before) + before.size();
    return text.substr(begin, text.find(after, begin) - begin);
}

// A limit that a message names can be written into the case.
TEST_F(FluidLimits, ALimitThatIsNamedIsAccepted) {
    const std::vector<std::string> cut = {"fluid.cells_per_diameter=7", "time.end=40"};
    const auto with = [](std::vector<std::string> sets, const std::string& more) {
        sets.push_back(more);
        return sets;
    };
    const std::string step =
        between(refusal("", with(cut, "time.step=20")), "step must be at most ", " t_c");
    EXPECT_EQ(step, at_most_text(2.0 / 3.0 * 1000.0 / (8.0 * 7.0), 3));
    EXPECT_EQ(refusal("", with(cut, "time.step=" + step)).find("step must be"), std::string::npos);

    const std::vector<std::string> stretched = {"fluid.stretch_ratio=1.07",
                                                "fluid.cells_per_diameter=7"};
    const std::string from =
        between(refusal("", with(stretched, "fluid.stretch_from=23.9")), "Use ", " or less");
    EXPECT_GT(std::stod(from), 1.0);
    EXPECT_EQ(refusal("", with(stretched, "fluid.stretch_from=" + from)).find("Rows need"),
              std::string::npos);
}

TEST(LimitText, IsRoundedToTheSideThatIsAllowed) {
    EXPECT_EQ(at_most_text(11.9048, 3), "11.9");
    EXPECT_EQ(at_least_text(11.9048, 3), "12");
    EXPECT_EQ(at_most_text(11.96, 3), "11.9");
    EXPECT_EQ(at_least_text(1.0001e-5, 3), "1.01e-05");
    EXPECT_EQ(at_most_text(-1.96, 2), "-2");
    // Its own round-off does not move a limit.
    EXPECT_EQ(at_most_text(3 * 0.1, 3), "0.3");
    EXPECT_EQ(at_least_text(3 * 0.1, 3), "0.3");
    EXPECT_EQ(at_least_text(0.0, 3), "0");
    EXPECT_EQ(at_most_text(INFINITY, 3), "inf");
}

// Rows and fields come at whole windows and outputs.
TEST_F(FluidLimits, IntervalsThatAreNotWholeAreTold) {
    const auto told = [&](const std::string& interval, const std::string& fields) {
        std::string all;
        for (const std::string& note :
             load("", {"output.interval=" + interval, "output.fields_interval=" + fields}).notes)
            if (note.find("interval") != std::string::npos) all += note + "\n";
        return all;
    };
    EXPECT_EQ(told("0.03", "0.06"), "");
    EXPECT_EQ(told("0.1", "5"), "") << "beyond the end";
    EXPECT_EQ(told("0.025", "0.06"),
              "output.interval = 0.025 is not a whole number of steps; rows come every 0.03 t_c\n");
    EXPECT_EQ(told("0.05", "0.07"),
              "output.fields_interval = 0.07 is not a whole number of "
              "outputs; fields come every 0.05 t_c\n");
    EXPECT_SAYS(told("0.001", "1"), "shorter than time.step");
    EXPECT_SAYS(told("0.1", "0.05"), "shorter than output.interval");
}

TEST_F(FluidLimits, FieldsAtAnIntervalBeyondAnyRunComeAtTheEnd) {
    const ResolvedCase resolved = load("", {"output.fields_interval=1e30"});
    EXPECT_GE(resolved.settings.integer("run.fields_every"),
              resolved.settings.integer("run.windows"));
}

TEST_F(FluidLimits, ABalanceWarnsBeforeItEndsTheRun) {
    const std::string text = refusal("", {"limits.grain_balance_hard=1e-9"});
    EXPECT_SAYS(text, "limits.grain_balance_hard = 1e-09");
    EXPECT_SAYS(text, "at least limits.grain_balance_soft = 1e-08");
    EXPECT_SAYS(refusal("", {"limits.fluid_balance_soft=0.5"}), "limits.fluid_balance_hard");
    EXPECT_EQ(refusal("", {"limits.fluid_balance_hard=1", "limits.fluid_balance_soft=1"}), "");
}

TEST_F(FluidLimits, ExtraFieldsAndProbesAreNamedAndPlaced) {
    EXPECT_SAYS(refusal("", {"output.fields=vorticity curl"}), "There is no field curl");
    EXPECT_SAYS(refusal("", {"output.probes=[1, 2, 3]"}), "two for each point");
    EXPECT_SAYS(refusal("", {"output.probes=[1, 2, 3, 25]"}), "Point 2 is outside the box");
    const ResolvedCase both = load("", {"output.fields=solid vorticity", "output.probes=[1, 24]"});
    EXPECT_EQ(both.settings.text("run.probes"), "1 24");
}

TEST_F(FluidLimits, Equation21NeedsAWeight) {
    const std::vector<std::string> settling = {"scales.kind=sedimentation",
                                               "coupling.scheme=joint"};
    const auto with = [&](const char* ratio) {
        std::vector<std::string> sets = settling;
        sets.push_back(ratio);
        return sets;
    };
    EXPECT_SAYS(refusal("", with("grains.density_ratio=1")), "Eq. 21");
    // Light grains rise as fast as grains that are heavier by as much sink.
    EXPECT_EQ(load("", with("grains.density_ratio=0.5")).scales.gravity,
              load("", with("grains.density_ratio=1.5")).scales.gravity);
}

// 10 x 10 D at D/1000 are 1e8 cells: 75 GB.
TEST_F(FluidLimits, AMeshBeyondTheMemoryIsRefusedWithBoth) {
    const std::vector<std::string> fine = {"domain.size=[10, 10]", "fluid.cells_per_diameter=1000"};
    const auto with = [&](const char* set) {
        std::vector<std::string> sets = fine;
        sets.push_back(set);
        return refusal("", sets);
    };
    EXPECT_SAYS(with("limits.memory=60"), "The mesh of 100 million cells takes about 83.1 GB");
    EXPECT_SAYS(with("limits.memory=60"), "there are 60 GB (limits.memory)");
    EXPECT_EQ(with("limits.memory=90"), "");
    EXPECT_SAYS(with("domain.size=[1e6, 1e6]"), "OpenFOAM counts up to 5e+08");
    EXPECT_EQ(refusal("", {"fluid.enabled=false", "domain.size=[1e4, 1e4]"}), "");
}

// A run that a larger machine has played: its grains are wanted, not its mesh.
TEST_F(FluidLimits, TheMeshOfARunFolderNeedNotFitIntoThisMachine) {
    ResolvedCase resolved =
        load("", {"domain.size=[10, 10]", "fluid.cells_per_diameter=1000", "limits.memory=90"});
    const auto memory = resolved.yaml.find("memory: 90");
    ASSERT_NE(memory, std::string::npos);
    resolved.yaml.replace(memory, 10, "memory: 60");
    folder.write("run/case.yaml", resolved.yaml);
    folder.write("run/grains/initial.csv", resolved.grains_csv);
    const auto run = folder.path() / "run";
    EXPECT_EQ(load_run_folder(run).population.size(), resolved.population.size());
    try {
        load_run_folder(run, {}, Machine::this_one);
        FAIL() << "83 GB in 60";
    } catch (const CaseRefused& refused) {
        EXPECT_SAYS(std::string(refused.what()), "there are 60 GB");
    }
}

/// 20 grains in 12 x 24 D, below 30 D of a higher box.
TEST_F(FluidLimits, StretchedRowsNeedAHeightAndRoom) {
    const auto with = [&](std::vector<std::string> sets) {
        sets.push_back("domain.size=[12, 60]");
        sets.push_back("grains.region=[12, 24]");
        return refusal("", sets);
    };
    EXPECT_SAYS(with({"fluid.stretch_ratio=1.05"}), "fluid.stretch_from is missing");
    EXPECT_SAYS(with({"fluid.stretch_ratio=1.3", "fluid.stretch_from=30"}), "from 1 up to 1.2");
    EXPECT_SAYS(with({"fluid.stretch_ratio=1.05", "fluid.stretch_from=60"}),
                "fluid.stretch_from = 60");
    EXPECT_SAYS(refusal("", {"domain.size=[12, 60.03]", "grains.region=[12, 24]",
                             "fluid.stretch_ratio=1.05", "fluid.stretch_from=59.8"}),
                "the domain ends at 60.03 D. Use 59.58 or less");
    EXPECT_SAYS(with({"fluid.stretch_ratio=1.05", "fluid.stretch_from=30", "domain.bottom=cyclic",
                      "domain.top=cyclic"}),
                "between cyclic sides");
    EXPECT_EQ(with({"fluid.stretch_ratio=1.05", "fluid.stretch_from=59.5"}), "");
    EXPECT_EQ(with({"fluid.stretch_from=60"}), "");  // without effect
}

TEST_F(FluidLimits, AStretchedMeshBeyondAllMeasureIsRefused) {
    // Found by a mutated case: its rows were counted one by one.
    const std::string text = refusal(
        "", {"domain.size=[60, 1e300]", "fluid.stretch_ratio=1.05", "fluid.stretch_from=24"});
    EXPECT_SAYS(text, "has more rows than any mesh");
}

TEST_F(FluidLimits, AGrainInStretchedRowsIsRefusedByItsNumber) {
    folder.write("g.csv", "id,x,y\n4,3,3\n7,5,10.2\n");
    const std::vector<std::string> stretched = {"grains.file=g.csv", "fluid.stretch_ratio=1.05",
                                                "fluid.stretch_from=10.5"};
    EXPECT_SAYS(refusal("", stretched), "grain 7: reaches y = 10.7 D");
    std::vector<std::string> allowed = stretched;
    allowed.push_back("fluid.allow_coarse=true");
    EXPECT_EQ(refusal("", allowed), "");
    allowed = stretched;
    allowed.push_back("fluid.stretch_from=10.7");
    EXPECT_EQ(refusal("", allowed), "");
}

/// 192 x 384 cells of D/16; stretched from 8 D on, 128 rows are equal.
TEST_F(FluidLimits, TheForecastCountsStretchedRows) {
    const ResolvedCase equal = load();
    const ResolvedCase stretched =
        load("", {"fluid.stretch_ratio=1.02", "fluid.stretch_from=8", "fluid.allow_coarse=true"});
    EXPECT_EQ(fluid_cells(equal.settings), 192.0 * 384.0);
    EXPECT_GT(fluid_rows(stretched.settings), 128.0 + 80.0);
    EXPECT_LT(fluid_rows(stretched.settings), 128.0 + 100.0);
    EXPECT_LT(fluid_memory(stretched.settings), fluid_memory(equal.settings));
    const ResolvedCase coupled =
        load("", {"fluid.splitting=explicit-multiplier", "coupling.scheme=joint"});
    EXPECT_NEAR(fluid_memory(coupled.settings) - fluid_memory(equal.settings),
                190e-9 * fluid_cells(equal.settings), 1e-12);
    const std::vector<std::string> odd = {"domain.size=[12, 24.03]", "fluid.stretch_ratio=1.02",
                                          "fluid.stretch_from=8", "fluid.allow_coarse=true"};
    EXPECT_EQ(refusal("", odd), "");  // any height
    EXPECT_SAYS(refusal("", {"domain.size=[12, 24.03]"}), "the mesh needs whole ones");
}

std::string notes_of(const ResolvedCase& resolved) {
    std::string all;
    for (const std::string& note : resolved.notes) all += note + "\n";
    return all;
}

TEST_F(FluidLimits, ReboundsThatTheFluidTakesBackAreTold) {
    const auto told = [this](const std::string& splitting, const std::string& restitution) {
        return notes_of(load("", {"coupling.scheme=joint", "fluid.splitting=" + splitting,
                                  "contact.restitution=" + restitution}));
    };
    const std::string weak = "rebounds come out too weak";
    EXPECT_SAYS(told("explicit-multiplier", "0.9"), weak);
    EXPECT_SAYS(told("marchuk-yanenko", "0.9"), "contact.restitution = 0.9");
    EXPECT_EQ(told("implicit-multiplier", "0.9").find(weak), std::string::npos);
    EXPECT_EQ(told("explicit-multiplier", "0").find(weak), std::string::npos);
    EXPECT_EQ(notes_of(load("", {"fluid.enabled=false", "contact.restitution=0.9"})).find(weak),
              std::string::npos);
}

// Pressure that knows rigid discs holds those that touch on the mesh together.
TEST_F(FluidLimits, GrainsThatPressureHoldsTogetherAreToldWithARadiusThatHelps) {
    const auto told = [this](const std::string& splitting, const std::string& radius, int cells) {
        return notes_of(load("", {"coupling.scheme=joint", "fluid.splitting=" + splitting,
                                  "fluid.hydrodynamic_radius=" + radius,
                                  "fluid.cells_per_diameter=" + std::to_string(cells)}));
    };
    const std::string held = "pressure may hold them together",
                      advice = "hydrodynamic_radius up to ";
    EXPECT_SAYS(told("implicit-multiplier", "0.97", 16), "leave 0.48 cells of fluid between them");
    EXPECT_EQ(told("marchuk-yanenko", "1", 8).find(held), std::string::npos);
    for (const int cells : {8, 10, 12, 16}) {
        const std::string note = told("explicit-multiplier", "1", cells);
        EXPECT_SAYS(note, held);
        const std::string radius = note.substr(note.find(advice) + advice.size(), 4);
        EXPECT_GT(std::stod(radius), 0.9);
        EXPECT_EQ(told("explicit-multiplier", radius, cells).find(held), std::string::npos);
    }
}

TEST(TransformLength, GoodOnesHaveSmallFactors) {
    EXPECT_EQ(largest_prime_factor(1), 1);
    EXPECT_EQ(largest_prime_factor(107), 107);
    EXPECT_EQ(largest_prime_factor(2 * 3 * 49), 7);
    EXPECT_EQ(good_transform_length(107), 108);
    EXPECT_EQ(good_transform_length(192), 192);
}

// nu dt/h2 = 0.01 16^2/0.1 = 25.6
TEST_F(FluidLimits, WhatOneCorrectionOfViscosityCannotDoIsTold) {
    const auto notes = [&](const char* reynolds, const char* splitting) {
        return notes_of(load("", {std::string("fluid.reynolds=") + reynolds,
                                  std::string("fluid.splitting=") + splitting, "time.step=0.01",
                                  "fluid.cells_per_diameter=16", "coupling.scheme=joint"}));
    };
    EXPECT_SAYS(notes("0.1", "explicit-multiplier"), "= 26 is more than one correction");
    EXPECT_SAYS(notes("0.1", "explicit-multiplier"), "use time.step <= 0.0039");
    EXPECT_EQ(notes("0.3", "explicit-multiplier").find("one correction"), std::string::npos);
    EXPECT_EQ(notes("0.1", "implicit-multiplier").find("one correction"), std::string::npos);
}

// (24 D/pi)^2 = 58.4 D2
TEST_F(FluidLimits, PressureThatTheToleranceLeavesOpenIsTold) {
    const auto notes = [&](const char* tolerance, const char* splitting = "implicit-multiplier") {
        return notes_of(load("", {std::string("fluid.splitting_tolerance=") + tolerance,
                                  std::string("fluid.splitting=") + splitting, "time.step=0.01",
                                  "domain.size=[12, 24]", "coupling.scheme=joint"}));
    };
    EXPECT_SAYS(notes("1e-3"), "= 5.8 rho_f u_c2");
    EXPECT_SAYS(notes("1e-3"), "use fluid.splitting_tolerance <= 2e-05");
    EXPECT_EQ(notes("1e-5").find("pressure may be off"), std::string::npos);
    EXPECT_EQ(notes("1e-3", "explicit-multiplier").find("pressure may be off"), std::string::npos);
}

// 107 = prime; along y there is no transform.
TEST_F(FluidLimits, SlowTransformsAreToldWithTheNextGoodLength) {
    const auto notes = [&](const char* size, const char* more = "time.end=1") {
        return notes_of(load("", {std::string("domain.size=") + size, "fluid.cells_per_diameter=8",
                                  "grains.region=[10, 10]", more}));
    };
    EXPECT_SAYS(notes("[13.375, 24]"), "107 cells along x have the prime factor 107");
    EXPECT_SAYS(notes("[13.375, 24]"), "13.5 D, 108 cells");
    EXPECT_EQ(notes("[24, 13.375]").find("prime"), std::string::npos);
    EXPECT_EQ(notes("[13.375, 24]", "fluid.enabled=false").find("prime"), std::string::npos);
}

TEST_F(FluidLimits, AGrainOfFewCellsIsRefusedByItsNumber) {
    EXPECT_EQ(refusal("", {"fluid.cells_per_diameter=4"}), "");
    EXPECT_SAYS(refusal("", {"fluid.cells_per_diameter=3"}), "at least 4 cells wide");
    EXPECT_EQ(refusal("", {"fluid.cells_per_diameter=3", "fluid.enabled=false"}), "");
}

}  // namespace
}  // namespace turbidite
