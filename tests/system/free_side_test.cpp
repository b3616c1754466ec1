// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Grains that leave a fluid through a free side, and what is left of a run without them.
#include "tests/system/history_columns.hpp"
#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

const char* const a_sphere = R"(
dimension: 3
domain:
  size: [6, 4, 2]
  left: inflow
  left_motion: stream
  right: free
  front: cyclic
  back: cyclic
  motions: {stream: {kind: constant, velocity: [1, 0, 0]}}
grains: {adapter: standalone-nscd, file: sphere.csv}
fluid: {reynolds: 20, cells_per_diameter: 8, program: box}
time: {step: 0.02, end: 2.4}
output: {interval: 0.2}
)";

const char* const a_disc = R"(
domain:
  size: [6, 4]
  left: inflow
  left_motion: stream
  right: free
  motions: {stream: {kind: constant, velocity: [1, 0]}}
grains: {adapter: standalone-nscd, file: disc.csv}
fluid: {reynolds: 20, cells_per_diameter: 8}
time: {step: 0.02, end: 2.4}
output: {interval: 0.2}
)";

class FreeSide : public ShellTest {
 protected:
    void SetUp() override {
        scratch.write("sphere.csv", "id,x,y,z\n1,4.5,2,1\n");
        scratch.write("disc.csv", "id,x,y\n1,4.5,2\n");
        scratch.write("sphere.yaml", a_sphere);
        scratch.write("disc.yaml", a_disc);
    }

    Columns history(const std::string& arguments) const {
        const Answer answer = shell(std::string(TURBIDITE_PROGRAM) + " run " + arguments +
                                    into_run_folder() + " --force");
        EXPECT_EQ(answer.code, 0) << answer.out << answer.err;
        return columns_of(text(run_folder() / "history.csv"));
    }

    /// In a box in which it leaves, and in one that is longer.
    void plays_alike(const std::string& the_case, double density) const {
        const std::string ratio = " --set grains.density_ratio=" + std::to_string(density);
        const Columns leaving = history(the_case + ".yaml" + ratio);
        const std::string longer = the_case == "disc" ? "[9, 4]" : "[9, 4, 2]";
        const Columns staying =
            history(the_case + ".yaml" + ratio + " --set \"domain.size=" + longer + "\"");
        EXPECT_EQ(leaving.at("grains").back(), 0.0);  // the run goes on without it
        EXPECT_EQ(staying.at("grains").back(), 1.0);
        std::size_t beyond = 0;
        for (std::size_t i = 1; i < leaving.at("time").size(); ++i) {
            if (leaving.at("grains")[i] == 0.0) break;
            EXPECT_LT(leaving.at("grain_balance")[i], 1e-11);
            EXPECT_LT(leaving.at("fluid_balance")[i], 1e-11);
            // front_x is x + R: some part of it is outside.
            if (leaving.at("front_x")[i] > 6.05) ++beyond;
            // Where it has left most of the fluid its weight speeds it up: by 0.15 u_c at most.
            for (const char* along : {"mean_velocity_x", "mean_velocity_y"})
                EXPECT_NEAR(leaving.at(along)[i], staying.at(along)[i], 0.15)
                    << the_case << " " << density << " " << along << " at "
                    << leaving.at("time")[i];
        }
        EXPECT_GE(beyond, 3u);
    }
};

// Of a density of 1.2, and of 1.02, next to nothing of the inertia is the excess mass of the
// sphere.
TEST_F(FreeSide, ASphereKeepsItsInertiaOnItsWayOut) {
    for (const double density : {1.02, 1.5}) plays_alike("sphere", density);
}

TEST_F(FreeSide, ADiscKeepsItsInertiaOnItsWayOut) {
    for (const double density : {0.9, 1.5}) plays_alike("disc", density);
}

}  // namespace
}  // namespace turbidite
