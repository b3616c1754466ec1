// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Shapes, sizes and inner walls of a case, and what is refused by name.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "launcher/case/case_file.hpp"
#include "launcher/case/grains/grain_forms.hpp"
#include "launcher/case/grains/packing/random_packing.hpp"
#include "launcher/case/walls/inner_walls.hpp"
#include "tests/unit/case/case_test.hpp"

namespace turbidite {
namespace {

constexpr auto dry_case =
    "domain: {size: [12, 24]}\n"
    "fluid: {enabled: false}\n"
    "time: {step: 0.01, end: 1}\n";

class ShapeCase : public CaseTest {
 protected:
    ShapeCase() : CaseTest(dry_case) {}

    void write_run(const ResolvedCase& resolved) {
        folder.write("run/case.yaml", resolved.yaml);
        folder.write("run/grains/initial.csv", resolved.grains_csv);
        folder.write("run/grains/walls.csv", resolved.walls_csv);
    }
};

TEST_F(ShapeCase, TrianglesHaveThePapersSizeAndRandomAngles) {
    const ResolvedCase box = load("grains: {shape: triangle, count: 40}\n");
    ASSERT_EQ(box.shapes.size(), 1u);
    EXPECT_EQ(box.shapes[0].kind, "triangle");
    EXPECT_EQ(box.shapes[0].vertices.size(), 6u);
    std::set<double> angles;
    for (const GrainState& grain : box.population) {
        EXPECT_EQ(grain.radius, 0.75);
        EXPECT_EQ(grain.shape, 0);
        EXPECT_NEAR(std::hypot(grain.orientation[0], grain.orientation[3]), 1.0, 1e-15);
        angles.insert(grain.orientation[3]);
    }
    EXPECT_EQ(angles.size(), 40u);
}

// A right triangle with legs of 3: its centre is (1, 1), its circumscribed radius about it sqrt 5.
TEST_F(ShapeCase, PolygonsAreMovedAndScaled) {
    const ResolvedCase box =
        load("grains: {shape: polygon, vertices: [0, 0, 3, 0, 0, 3], radius: 0.6, count: 5}\n");
    ASSERT_EQ(box.shapes[0].vertices.size(), 6u);
    EXPECT_NEAR(box.shapes[0].vertices[0], -1.0 / std::sqrt(5.0), 1e-15);
    EXPECT_EQ(box.population[0].radius, 0.6);
    EXPECT_TRUE(std::any_of(box.notes.begin(), box.notes.end(), [](const std::string& note) {
        return note.find("moved by (-1, -1)") != std::string::npos;
    }));
    const ResolvedCase again = load_case(folder.write("again.yaml", box.yaml));
    EXPECT_EQ(again.yaml, box.yaml);
    EXPECT_EQ(again.shapes[0].vertices, box.shapes[0].vertices);
}

TEST_F(ShapeCase, BadPolygonsAreRefusedByVertex) {
    const auto with = [this](const std::string& vertices) {
        return refusal("grains: {shape: polygon, count: 5, vertices: [" + vertices + "]}\n");
    };
    EXPECT_SAYS(with("0, 0, 2, 0, 1, 0.5, 2, 2, 0, 2"), "vertex 3 (1, 0.5) makes it concave");
    EXPECT_SAYS(with("0, 0, 1, 0, 1, 1, 1, 0"), "vertex 4 (1, 0) is the same as vertex 2");
    EXPECT_SAYS(with("0, 0, 1, 1, 2, 2"), "area is zero");
    EXPECT_SAYS(with("0, 0, 1, 1"), "at least 3");
    EXPECT_SAYS(with("0, 0, 1, x, 2, 2"), "A list x1, y1, x2, y2");
    EXPECT_SAYS(refusal("grains: {shape: polygon, count: 5}\n"), "grains.vertices is missing");
    EXPECT_SAYS(refusal("grains: {shape: hexagon, count: 5}\n"), "disc, triangle, polygon");
}

TEST_F(ShapeCase, LatticesHoldEqualDiscsOnly) {
    const std::string lattice = "grains: {generator: lattice, ";
    EXPECT_SAYS(refusal(lattice + "shape: triangle}\n"), "grains.shape = triangle");
    EXPECT_SAYS(refusal(lattice + "radius: 0.4}\n"), "grains.radius = 0.4");
    EXPECT_SAYS(refusal(lattice + "size_ratio: 2}\n"), "grains.size_ratio = 2");
    EXPECT_EQ(refusal(lattice + "radius: 0.5}\n"), "");
}

// Ratio 3 about R = 0.5: radii from 0.25 to 0.75, with mean 0.5 and a standard error of
// 0.144/sqrt(60).
TEST_F(ShapeCase, SizesSpreadAboutTheMean) {
    const ResolvedCase box = load("grains: {count: 60, size_ratio: 3}\n");
    double sum = 0.0, least = 1.0, most = 0.0;
    for (const GrainState& grain : box.population) {
        sum += grain.radius;
        least = std::min(least, grain.radius), most = std::max(most, grain.radius);
    }
    EXPECT_GE(least, 0.25);
    EXPECT_LE(most, 0.75);
    EXPECT_LT(least, 0.3);
    EXPECT_GT(most, 0.7);
    EXPECT_NEAR(sum / 60.0, 0.5, 0.06);
}

TEST_F(ShapeCase, TooManyGrainsAreRefused) {
    EXPECT_SAYS(refusal("grains: {shape: triangle, count: 600}\n"), "grains.count = 600");
    EXPECT_SAYS(refusal("grains: {count: 3, radius: 7}\n"), "has no room");
}

TEST_F(ShapeCase, FilesMixShapes) {
    folder.write("g.csv",
                 "id,x,y,shape,angle\n4,2,2,triangle,0.5\n5,6,2,disc,0\n6,6,6,polygon,1\n");
    const std::string vertices = "vertices: [0, 0, 1, 0, 1, 1, 0, 1]";
    const ResolvedCase box = load("grains: {file: g.csv, " + vertices + "}\n");
    ASSERT_EQ(box.shapes.size(), 3u);
    const auto kind = [&](std::size_t i) {
        return box.shapes[static_cast<std::size_t>(box.population[i].shape)].kind;
    };
    EXPECT_EQ(kind(0), "triangle");
    EXPECT_EQ(kind(1), "disc");
    EXPECT_EQ(kind(2), "polygon");
    EXPECT_EQ(box.population[0].radius, 0.75);
    EXPECT_EQ(box.population[2].radius, 0.5);
    EXPECT_NEAR(box.population[0].orientation[3], std::sin(0.25), 1e-15);
    write_run(box);
    const ResolvedCase again = load_run_folder(folder.path() / "run");
    EXPECT_EQ(again.settings.entries(), box.settings.entries());
    EXPECT_EQ(again.population[2].orientation, box.population[2].orientation);
    EXPECT_EQ(again.population[2].shape, box.population[2].shape);
}

// Programs need to support only the shapes in use: a file of discs needs no polygons.
TEST_F(ShapeCase, TheTableHoldsWhatIsUsed) {
    folder.write("g.csv", "id,x,y,shape\n4,2,2,triangle\n");
    const ResolvedCase box = load("grains: {file: g.csv}\n");
    ASSERT_EQ(box.shapes.size(), 1u);
    EXPECT_EQ(box.shapes[0].kind, "triangle");
    EXPECT_EQ(box.population[0].shape, 0);
}

TEST_F(ShapeCase, FilesWithUnknownShapesAreRefused) {
    const std::string text = refusal_of_grains("id,x,y,shape\n4,2,2,hexagon\n5,5,5,polygon\n");
    EXPECT_SAYS(text, "g.csv line 2: shape = hexagon");
    EXPECT_SAYS(text, "g.csv line 3: shape = polygon");
    EXPECT_SAYS(text, "grains.vertices");
}

// Circles of radius 0.75 with centres at distance 1.2 overlap; triangles whose sides face each
// other need only 0.75, and one that points at the other's side 1.125.
TEST_F(ShapeCase, OverlapsAreThoseOfTheShapes) {
    const std::string head = "id,x,y,shape,angle\n1,3,3,triangle,0\n";
    EXPECT_EQ(refusal_of_grains(head + "2,3,1.8,triangle,0\n"), "");
    EXPECT_SAYS(refusal_of_grains(head + "2,3,2,triangle,0\n"),
                "grains 1 and 2 overlap by 0.125 D");
}

// A triangle at angle 0 extends 0.375 downwards and 0.75 upwards from its centre.
TEST_F(ShapeCase, GrainsOutsideAreJudgedByTheirShapes) {
    EXPECT_EQ(refusal_of_grains("id,x,y,shape\n1,3,0.38,triangle\n"), "");
    const std::string text =
        refusal_of_grains("id,x,y,shape\n1,3,0.3,triangle\n2,3,23.3,triangle\n");
    EXPECT_SAYS(text, "0.075 D beyond its bottom side");
    EXPECT_SAYS(text, "0.05 D beyond its top side");
}

TEST(ShapePacking, TrianglesKeepTheirDistance) {
    Settings settings;
    settings.set("grains.shape", std::string("triangle"));
    const GrainForms forms = make_grain_forms(settings);
    const PackingRequest request{
        .box = {.width = 12.0, .height = 20.0}, .count = 110, .seed = 3, .forms = &forms};
    const Packing grains = random_packing(request).grains;
    ASSERT_EQ(grains.size(), 110u);  // denser than possible for circumscribed circles: 0.81
    double least = 1e9;
    for (std::size_t i = 0; i < grains.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            least = std::min(least, surface_gap(placed_outline(grains[i], forms),
                                                placed_outline(grains[j], forms)));
    EXPECT_GE(least, 0.005 - 1e-9);
}

class WallsFile : public ShapeCase {
 protected:
    const std::string grains = "grains: {count: 5, adapter: standalone-nscd}\n";

    std::string refused(const std::string& csv) {
        folder.write("walls.csv", csv);
        return refusal(grains, {"domain.walls_file=walls.csv"});
    }
};

TEST_F(WallsFile, IsHandedOnInTheRunsUnits) {
    folder.write("grains.csv", "id,x,y\n0,3,20\n");
    folder.write("walls.csv", "id,x1,y1,x2,y2,vx,vy,spin\n1,0,5,8,5,0.5,0,0\n7,2,9,4,9,0,0,0.1\n");
    const ResolvedCase box = load("grains: {file: grains.csv, adapter: standalone-nscd}\n",
                                  {"domain.walls_file=walls.csv", "contact.friction=0.4"});
    EXPECT_EQ(box.settings.text("run.walls"),
              "1 0 5 8 5 0.5 0 0 4 5 0.4 0;7 2 9 4 9 0 0 0.1 3 9 0.4 0");
    EXPECT_EQ(box.settings.text("domain.walls_file"), "grains/walls.csv");
    write_run(box);
    const ResolvedCase again = load_run_folder(folder.path() / "run");
    EXPECT_EQ(again.settings.entries(), box.settings.entries());
}

// One with a friction of its own, one with that of the case.
TEST_F(WallsFile, AnEmptyFieldHasWhatAFileWithoutTheColumnHas) {
    folder.write("grains.csv", "id,x,y\n0,3,20\n");
    folder.write("walls.csv",
                 "id,x1,y1,x2,y2,thickness,friction\n1,0,5,8,5,,0.7\n7,2,9,4,9,0.3,\n");
    const ResolvedCase box = load("grains: {file: grains.csv, adapter: standalone-nscd}\n",
                                  {"domain.walls_file=walls.csv", "contact.friction=0.4"});
    EXPECT_EQ(box.settings.text("run.walls"),
              "1 0 5 8 5 0 0 0 4 5 0.7 0;7 2 9 4 9 0 0 0 3 9 0.4 0.3");
    write_run(box);
    const ResolvedCase again = load_run_folder(folder.path() / "run");
    EXPECT_EQ(again.settings.entries(), box.settings.entries());
}

TEST_F(WallsFile, NonsenseIsRefusedByLine) {
    EXPECT_SAYS(refused("id,x1,y1,x2,y2\n1,3,3,3,3\n"), "walls.csv line 2: wall 1 has length 0");
    EXPECT_SAYS(refused("id,x1,y1,x2,y2\n1,3,3,4,3\n1,5,5,6,6\n"), "wall id 1 is given twice");
    EXPECT_SAYS(refused("id,x1,y1,x2\n1,3,3,4\n"), "column \"y2\" is missing");
    EXPECT_SAYS(refused("id,x1,y1,x2,y2,vx\n1,3,3,4,3,1\n"), "only one is given");
    EXPECT_SAYS(refused("id,x1,y1,x2,y2,thickness\n1,3,3,4,3,-1\n"), "thickness = -1");
    EXPECT_SAYS(refused("id,x1,y1,x2,y2,friction\n1,3,3,4,3,-1\n"), "friction = -1");
    EXPECT_SAYS(refused("id,x1,y1,x2,y2\n1,3,nan,4,3\n"), "y1 = nan");
    EXPECT_SAYS(refused("id,x1,y1,x2,y2,colour\n1,3,3,4,3,2\n"), "column \"colour\" is unknown");
    EXPECT_SAYS(refused("id,x1,y1,x2,y2\n"), "contains no wall");
    EXPECT_SAYS(refusal(grains, {"domain.walls_file=none.csv"}), "There is no file");
}

TEST_F(WallsFile, GrainsThatAWallCutsAreNamed) {
    folder.write("grains.csv", "id,x,y\n9,3,3.2\n");
    folder.write("walls.csv", "id,x1,y1,x2,y2\n1,0,3,8,3\n");
    EXPECT_SAYS(refusal("grains: {file: grains.csv, adapter: standalone-nscd}\n",
                        {"domain.walls_file=walls.csv"}),
                "wall 1 cuts grain 9 at (3, 3.2) by 0.3 D");
}

// The image of the wall's end is at (0, 3): sqrt(0.3^2 + 0.2^2) = 0.5 - 0.1394 from the centre.
TEST_F(WallsFile, GrainsThatAnImageCutsAreNamed) {
    folder.write("grains.csv", "id,x,y\n9,0.3,3.2\n");
    folder.write("walls.csv", "id,x1,y1,x2,y2\n1,8,3,10,3\n");
    std::vector<std::string> set = {"domain.walls_file=walls.csv", "domain.size=[10,20]",
                                    "domain.left=cyclic", "domain.right=cyclic"};
    EXPECT_SAYS(refusal("grains: {file: grains.csv, adapter: standalone-nscd}\n", set),
                "wall 1 cuts grain 9 at (0.3, 3.2) by 0.1394 D");
    for (const std::string adapter : {"yade-md", "lammps-md", "standalone-md"}) {
        const std::string text =
            refusal("grains: {file: grains.csv, adapter: " + adapter + "}\n", set);
        EXPECT_SAYS(text, "need a contact-dynamics adapter, not " + adapter);
        if (adapter == "yade-md") {
            EXPECT_SAYS(text, "yade-md does not support cyclic sides");
        }
    }
}

/// It would lie on its own images. From side to side it may be thick.
TEST_F(WallsFile, AWallThatIsLongerThanTheBoxRepeatsIsRefused) {
    folder.write("grains.csv", "id,x,y\n9,3,6\n");
    const auto with = [&](const std::string& row, const std::string& sides) {
        folder.write("walls.csv", "id,x1,y1,x2,y2,thickness\n" + row);
        return refusal("grains: {file: grains.csv, adapter: standalone-nscd}\n",
                       {"domain.walls_file=walls.csv", "domain.size=[10,20]",
                        "domain.left=" + sides, "domain.right=" + sides});
    };
    EXPECT_EQ(with("1,-2,3,10,3,0\n", "wall"), "");
    EXPECT_SAYS(with("1,-2,3,10,3,0\n", "cyclic"), "wall 1 is 12 D long along x");
    EXPECT_EQ(with("1,0,3,10,3,0.4\n", "cyclic"), "");
    EXPECT_EQ(with("1,4,3,4,12,0.4\n", "cyclic"), "");
    folder.write("walls.csv", "id,x1,y1,x2,y2,thickness,spin\n1,4,3,4,15,0.4,0.1\n");
    const std::vector<std::string> turning = {"domain.walls_file=walls.csv", "domain.size=[10,20]",
                                              "domain.left=cyclic", "domain.right=cyclic"};
    EXPECT_SAYS(refusal("grains: {file: grains.csv, adapter: standalone-nscd}\n", turning),
                "wall 1 is 12.0067 D long along x when it has turned");
}

/// By spin it lies flat once; of a rocking one the angle decides.
TEST_F(WallsFile, AWallThatAMotionTurnsIsNotLongerThanTheBoxRepeatsEither) {
    folder.write("grains.csv", "id,x,y\n9,1,6\n");
    folder.write("walls.csv", "id,x1,y1,x2,y2,thickness,motion\n1,5,3,5,15,0.4,rock\n");
    const auto with = [&](std::vector<std::string> motion) {
        motion.insert(motion.end(), {"domain.walls_file=walls.csv", "domain.size=[10,20]",
                                     "domain.left=cyclic", "domain.right=cyclic"});
        return refusal("grains: {file: grains.csv, adapter: standalone-nscd}\n", motion);
    };
    const std::string constant = "domain.motions.rock.kind=constant",
                      harmonic = "domain.motions.rock.kind=harmonic",
                      period = "domain.motions.rock.period=4";
    EXPECT_EQ(with({constant, "domain.motions.rock.velocity=[0, 0.1]"}), "");
    EXPECT_SAYS(with({constant, "domain.motions.rock.spin=0.1"}),
                "wall 1 is 12.0067 D long along x when it has turned");
    // 0.4 cos(a) + 12 sin(a) is 10 at a = 0.951.
    EXPECT_EQ(with({harmonic, period, "domain.motions.rock.turn=0.94"}), "");
    EXPECT_SAYS(with({harmonic, period, "domain.motions.rock.turn=-0.96"}), "long along x");
    // From the end of its way it turns by twice as much.
    EXPECT_SAYS(with({harmonic, period, "domain.motions.rock.turn=0.5",
                      "domain.motions.rock.phase=1.5707963"}),
                "long along x");
    folder.write("walls.csv", "id,x1,y1,x2,y2,thickness,motion\n1,-2,3,10,3,0.4,rock\n");
    EXPECT_SAYS(with({constant, "domain.motions.rock.velocity=[0, 0.1]"}),
                "wall 1 is 12 D long along x");
}

/// Rows above 8 D grow to some 0.8 D: what lies across them must be thicker there.
TEST_F(WallsFile, WhereRowsAreStretchedAWallIsAsThickAsTwoOfThem) {
    folder.write("grains.csv", "id,x,y\n9,0.6,1\n");
    const auto with = [&](const std::string& row) {
        folder.write("walls.csv", "id,x1,y1,x2,y2,thickness\n" + row);
        return refusal(
            "grains: {file: grains.csv, adapter: standalone-nscd}\n",
            {"domain.walls_file=walls.csv", "fluid.enabled=true", "fluid.reynolds=36",
             "fluid.cells_per_diameter=16", "domain.size=[8, 24]", "fluid.stretch_ratio=1.05",
             "fluid.stretch_from=8", "fluid.allow_coarse=true"});
    };
    EXPECT_EQ(with("1,1,7.5,7,7.5,0.125\n"), "");
    EXPECT_SAYS(with("1,1,22,7,22,0.125\n"), "larger fluid.stretch_from");
    EXPECT_EQ(with("1,1,22,7,22,1.7\n"), "");
    EXPECT_EQ(with("1,6,10,6,22,0.125\n"), "") << "an upright one";
    EXPECT_SAYS(with("1,2,16,6,20,0.125\n"), "at least 2 cells");
}

TEST_F(WallsFile, IsForContactEnginesWithOrWithoutAFluid) {
    folder.write("walls.csv", "id,x1,y1,x2,y2\n1,0,0.001,8,0.001\n");
    const std::vector<std::string> wet = {"domain.walls_file=walls.csv", "fluid.enabled=true",
                                          "fluid.reynolds=36"};
    EXPECT_SAYS(refusal(grains, wet), "The fluid would pass through it: at least 2 cells, here");
    folder.write("walls.csv", "id,x1,y1,x2,y2,thickness\n1,0,0.001,8,0.001,0.125\n");
    EXPECT_SAYS(load(grains, wet).settings.text("run.walls"), " 0.3 0.125");
    EXPECT_SAYS(refusal("grains: {file: grains.csv, adapter: yade-md}\n", wet),
                "need a contact-dynamics adapter, not yade-md");
}

}  // namespace
}  // namespace turbidite
