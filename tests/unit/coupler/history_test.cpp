// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include "coupler/hub/history.hpp"
#include "tests/unit/coupler/test_case.hpp"

namespace turbidite {
namespace {

// The columns are a contract with tools outside the project: this list is the contract, not a copy of the code.
TEST(History, HeaderIsTheContract) {
    EXPECT_EQ(history_header().find(
                  "step,time,mean_velocity_x,mean_velocity_y,mean_velocity_norm,mean_speed,"
                  "mean_position_x,mean_position_y,front_x,kinetic_energy,grains,contacts,"
                  "max_penetration,contact_iterations,contact_residual,multiplier_iterations,"
                  "multiplier_residual,divergence,pore_volume,wall_step,wall_fluid,wall_grains,"
                  "wall_coupling,grain_balance,fluid_balance,joint_rounds,joint_mismatch"),
              0u);
}

// Three discs at x = 2, 4.5, 7 with velocities (3, 4), (-3, 4), (0, 4): |<u>| = 4, <|u|> = (5 + 5 + 4)/3, front 7.5,
// energy per mass (25 + 25 + 16)/6.
TEST(History, MeansAreNumberMeans) {
    Motion state;
    state.grains = test_population();
    state.grains[0].velocity = {3, 4, 0};
    state.grains[1].velocity = {-3, 4, 0};
    state.grains[2].velocity = {0, 4, 0};
    const KickRule rule(test_settings(), {{"disc", {}}});
    const Averages mean = averages(state, rule);
    EXPECT_NEAR(mean.velocity[0], 0.0, 1e-15);
    EXPECT_NEAR(mean.velocity[1], 4.0, 1e-15);
    EXPECT_NEAR(mean.speed, 14.0 / 3.0, 1e-14);
    EXPECT_NEAR(mean.front, 7.5, 1e-15);
    EXPECT_NEAR(mean.kinetic_energy / mean.mass, 66.0 / 6.0, 1e-13);
}

// A disc spinning at w has I w^2/2 = M R^2 w^2/4: with R = 0.5, w = 2 that is M/4.
TEST(History, SpinCountsAsKineticEnergy) {
    Motion state;
    state.grains = {test_population()[0]};
    state.grains[0].angular_velocity = {0, 0, 2};
    const KickRule rule(test_settings(), {{"disc", {}}});
    const Averages mean = averages(state, rule);
    EXPECT_NEAR(mean.kinetic_energy / mean.mass, 0.25, 1e-15);
}

TEST(History, AFullDiskIsAnError) {
    EXPECT_THROW(History("/dev/full", test_settings(), KickRule(test_settings(), {{"disc", {}}})), Failure);
}

}  // namespace
}  // namespace turbidite
