// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Fixed and driven grains in the fluid, and a fluid driven by a body force.
#include <algorithm>
#include <numbers>

#include "tests/system/history_columns.hpp"
#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

/// Grain 3 falls into the gap between two fixed ones, one of them lighter than the fluid; grain 4
/// is driven past them.
const char* const a_pile =
    "id,x,y,vx,vy,density,motion\n1,2.5,1.5,0,0,1.5,fixed\n2,3.5,1.5,0,0,0.5,fixed\n"
    "3,3.02,3.5,0,0,1.5,free\n4,0.8,2.5,0,-0.1,1.5,driven\n";

const char* const in_a_box = R"(
domain: {size: [6, 6]}
grains: {adapter: standalone-nscd, file: grains.csv, density_ratio: 1.5}
fluid: {reynolds: 50, cells_per_diameter: 8}
contact: {friction: 0.3}
time: {step: 0.02, end: 10}
output: {interval: 3}
)";

const char* const in_a_cyclic_box = R"(
domain: {size: [3, 2], left: cyclic, right: cyclic, bottom: cyclic, top: cyclic}
grains: {adapter: standalone-nscd, file: grains.csv, density_ratio: 1.5}
fluid: {reynolds: 10, cells_per_diameter: 8}
time: {step: 0.01, end: 0.4}
output: {interval: 0.01}
)";

constexpr double area = 6.0;  // of the cyclic box

class HeldGrains : public ShellTest {
 protected:
    Columns play(const std::string& changes) {
        const Answer answer =
            shell(std::string(TURBIDITE_PROGRAM) + " run case.yaml --force --out run" + changes);
        EXPECT_EQ(answer.code, 0) << changes << answer.out << answer.err;
        EXPECT_LT(record().at("maxima").at("grain_balance").get<double>(), 1e-10) << changes;
        EXPECT_LT(record().at("maxima").at("fluid_balance").get<double>(), 1e-10) << changes;
        return columns_of(text(run_folder() / "history.csv"));
    }

    /// Centres at the end of the box case.
    std::vector<double> landed(const std::string& changes) {
        const Columns run = play(changes);
        EXPECT_EQ(run.at("contacts").back(), 2.0) << changes;
        EXPECT_NEAR(run.at("mean_speed").back(), 0.1 / 4.0, 1e-5) << changes;  // grain 4 alone
        return centres("00000500");
    }
};

// At rest the free grain lies on both fixed ones: a triangle of side D.
TEST_F(HeldGrains, AGrainLandsOnFixedOnesUnderEverySchemeAndHost) {
    scratch.write("grains.csv", a_pile);
    scratch.write("case.yaml", in_a_box);
    std::vector<std::vector<double>> each;
    for (const std::string changes :
         {" --set coupling.scheme=joint", " --set coupling.scheme=split",
          " --set coupling.scheme=joint --set fluid.ranks=2",
          " --set coupling.scheme=joint --set grains.adapter=yade-nscd",
          " --set coupling.scheme=split --set grains.adapter=yade-nscd"})
        each.push_back(landed(changes));
    const double top = 1.5 + std::numbers::sqrt3 / 2.0;
    for (const std::vector<double>& centres : each)
        EXPECT_LT(largest_difference(centres, {2.5, 1.5, 0, 3.5, 1.5, 0, 3, top, 0, 0.8, 1.5, 0}),
                  1e-4);
    EXPECT_EQ(each[3], each[0]);
    EXPECT_EQ(each[4], each[1]);
}

// What a driven grain gives to a cyclic fluid is all the momentum that the fluid has.
TEST_F(HeldGrains, ADrivenGrainDragsTheFluidWithIt) {
    scratch.write("grains.csv", "id,x,y,vx,motion\n1,1.5,1,0.3,driven\n");
    scratch.write("case.yaml", in_a_cyclic_box);
    const Columns run = play("");
    double given = 0.0;
    for (std::size_t k = 1; k < run.at("time").size(); ++k) {
        EXPECT_LT(run.at("fluid_force_x")[k], 0.0);
        given -= 0.01 * run.at("fluid_force_x")[k];
        EXPECT_NEAR(run.at("flow_x")[k] * area, given, 1e-9);
    }
    EXPECT_GT(run.at("flow_x").back(), 0.1);
    EXPECT_EQ(run.at("mean_velocity_x").back(), 0.3);
}

// The same problem seen by an observer who moves with the grain: the fluid is driven, to which the
// force on the grain adds up.
TEST_F(HeldGrains, ABodyForceIsAllThatFluidAndGrainTake) {
    scratch.write("grains.csv", "id,x,y,motion\n1,1.5,1,fixed\n");
    scratch.write("case.yaml", in_a_cyclic_box);
    for (const char* how :
         {"", " --set fluid.ranks=2", " --set fluid.ranks=2 --set fluid.decomposition=columns",
          " --set fluid.pressure_solver=GAMG", " --set fluid.time_scheme=first-order"}) {
        const Columns run = play(std::string(" --set \"fluid.acceleration=[0.5, -0.2]\"") + how);
        double x = 0.0, y = 0.0;
        for (std::size_t k = 1; k < run.at("time").size(); ++k) {
            x += 0.01 * (0.5 * area - run.at("fluid_force_x")[k]);
            y += 0.01 * (-0.2 * area - run.at("fluid_force_y")[k]);
            EXPECT_NEAR(run.at("flow_x")[k] * area, x, 1e-9) << how;
            EXPECT_NEAR(run.at("flow_y")[k] * area, y, 1e-9) << how;
        }
        EXPECT_GT(run.at("fluid_force_x").back(), 0.5) << how;
        EXPECT_LT(run.at("fluid_force_x").back(), 0.5 * area) << how;
    }
}

// A grain of the fluid's density moves with a fluid that is driven as a whole: u = a t everywhere,
// and the force on it is that of the mean pressure gradient, rho_f V a.
TEST_F(HeldGrains, ANeutralGrainFollowsADrivenFluid) {
    scratch.write("grains.csv", "id,x,y\n1,1.5,1\n");
    scratch.write("case.yaml", in_a_cyclic_box);
    for (const char* radius : {"1", "0.8"}) {
        const Columns run =
            play(std::string(" --set grains.density_ratio=1 --set coupling.scheme=joint --set "
                             "\"fluid.acceleration=[0.5, 0]\" --set fluid.hydrodynamic_radius=") +
                 radius);
        EXPECT_NEAR(run.at("mean_velocity_x").back(), 0.2, 1e-12) << radius;
        EXPECT_NEAR(run.at("flow_x").back(), 0.2, 1e-12) << radius;
        EXPECT_NEAR(run.at("fluid_force_x").back(), 0.5 * std::numbers::pi / 4.0, 1e-9) << radius;
    }
}

// The probe in the grain shows its velocity; the others show the same on any number of ranks.
TEST_F(HeldGrains, ProbesAndFieldsAreWrittenWhenAsked) {
    scratch.write("grains.csv", "id,x,y,vx,motion\n1,1.5,1,0.3,driven\n");
    scratch.write("case.yaml", in_a_cyclic_box);
    std::vector<Columns> probes;
    for (const std::string ranks : {"1", "2"}) {
        play(
            " --set \"output.fields=vorticity solid\" --set \"output.probes=[1.5, 1, 2.5, 1.5, 0, "
            "2]\" --set output.interval=0.2 --set fluid.multiplier_tolerance=1e-9 --set "
            "fluid.ranks=" +
            ranks);
        probes.push_back(columns_of(text(run_folder() / "probes.csv")));
        const std::string folder = ranks == "1" ? "fluid/" : "fluid/processor1/";
        for (const char* field : {"vorticity", "solid", "lambda", "p", "U"})
            EXPECT_TRUE(std::filesystem::exists(run_folder() / (folder + "0.4/" + field)));
    }
    ASSERT_EQ(probes[0].at("time"), (std::vector<double>{0.2, 0.4}));
    EXPECT_NEAR(probes[0].at("velocity_x_1").back(), 0.3, 1e-9);
    EXPECT_GT(probes[0].at("velocity_x_2").back(), 0.01);
    EXPECT_NE(probes[0].at("pressure_2").back(), probes[0].at("pressure_3").back());
    for (const auto& [name, values] : probes[0])
        EXPECT_LT(largest_difference(values, probes[1].at(name)), 1e-7) << name;
}

TEST_F(HeldGrains, ABodyForceBetweenWallsIsRefused) {
    scratch.write("grains.csv", a_pile);
    scratch.write("case.yaml", in_a_box);
    const Answer answer = shell(std::string(TURBIDITE_PROGRAM) +
                                " check case.yaml --set \"fluid.acceleration=[0, 0.1]\"");
    EXPECT_EQ(answer.code, 2);
    EXPECT_SAYS(answer.err + answer.out, "fluid.acceleration = [0, 0.1]");
    EXPECT_SAYS(answer.err + answer.out, "domain.bottom is wall");
}

const char* const a_funnel = R"(
domain: {size: [6, 8], walls_file: walls.csv, motions: {shake: {kind: harmonic, amplitude: [0.3, 0], period: 2}}}
grains: {adapter: standalone-nscd, file: grains.csv, density_ratio: 1.5}
fluid: {reynolds: 400, cells_per_diameter: 8, splitting: explicit-multiplier}
contact: {friction: 0.3}
time: {step: 0.02, end: 8}
output: {interval: 0.5}
)";

// Grains sink onto the inclined plates of a funnel and slide down, on the film of fluid that is
// left at first; a grain at its outlet shakes from side to side.
TEST_F(HeldGrains, PlatesHoldGrainsAndFluidUnderEverySchemeAndHost) {
    scratch.write("walls.csv",
                  "id,x1,y1,x2,y2,thickness\n1,0,4,2.2,2.5,0.25\n2,6,4,3.8,2.5,0.25\n");
    scratch.write("grains.csv",
                  "id,x,y,motion\n1,1.2,4.6,free\n2,3,5,free\n3,4.8,4.6,free\n4,3,2,shake\n"
                  "5,1.9,5.9,free\n6,4.1,5.9,free\n");
    scratch.write("case.yaml", a_funnel);
    std::vector<std::vector<double>> each;
    for (const std::string changes :
         {"", " --set fluid.ranks=2", " --set grains.adapter=yade-nscd",
          " --set coupling.scheme=split --set fluid.splitting=marchuk-yanenko"}) {
        const Columns run = play(changes);
        EXPECT_GT(*std::max_element(run.at("contacts").begin() + 1, run.at("contacts").end()), 0.0)
            << changes;
        const std::vector<double> x = centres("00000400");
        ASSERT_EQ(x.size(), 18u) << changes;
        EXPECT_NEAR(x[9], 3.0, 1e-9) << changes;                    // four periods of the motion
        EXPECT_NEAR(centres("00000025")[9], 3.3, 1e-9) << changes;  // a quarter of one
        EXPECT_NEAR(centres("00000075")[9], 2.7, 1e-9) << changes;
        for (const int k : {0, 2}) EXPECT_GT(x[3 * k + 1], 3.5) << changes;
        each.push_back(x);
    }
    EXPECT_EQ(each[2], each[0]);
    EXPECT_LT(largest_difference(each[1], each[0]), 1e-3);
    scratch.write("walls.csv", "id,x1,y1,x2,y2,thickness\n1,0,0.1,0.2,0.1,0.25\n");
    play("");
    EXPECT_GT(largest_difference(centres("00000400"), each[0]), 0.5);  // without the funnel
}

}  // namespace
}  // namespace turbidite
