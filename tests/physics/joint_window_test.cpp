// SPDX-License-Identifier: GPL-3.0-or-later
//
// Windows of fluid and contacts in the order of `joint`: what is told about a window holds for what
// leaves it. Run units: D = u_c = rho_f = 1.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/physics/coupled_run.hpp"

namespace turbidite {
namespace {

/// Three discs that fall on the floor and on each other, with open pores between them.
CoupledSetup heap(const std::string& splitting) {
    CoupledSetup setup;
    setup.cells_per_diameter = 8;
    setup.gravity = 11.86;
    setup.reynolds = 50.0;
    setup.tolerance = 1e-7;
    setup.splitting = splitting;
    setup.hydrodynamic_radius = 0.85;
    setup.contact_tolerance = 1e-7;
    return setup;
}

std::vector<GrainState> three_discs(const CoupledSetup& setup) {
    return {disc_at(setup, 1.5, 0.53), disc_at(setup, 2.52, 0.53), disc_at(setup, 2.05, 1.45)};
}

/// Largest |U^{n+1} - U| + R |omega^{n+1} - omega|, U of the last contact solve.
double largest_difference_from_contacts(const CoupledRun& run) {
    double largest = 0.0;
    for (std::size_t g = 0; g < run.grains().size(); ++g) {
        const GrainState &now = run.grains()[g], &then = run.between()[g];
        largest = std::max(
            largest,
            std::hypot(now.velocity[0] - then.velocity[0], now.velocity[1] - then.velocity[1]) +
                now.radius * std::abs(now.angular_velocity[2] - then.angular_velocity[2]));
    }
    return largest;
}

class JointWindow : public testing::TestWithParam<const char*> {};

/// Contacts are judged by the velocities that leave the window, whatever the fluid has corrected
/// after them.
TEST_P(JointWindow, EndsWithVelocitiesThatItsContactsAdmit) {
    const CoupledSetup setup = heap(GetParam());
    CoupledRun run(setup, three_discs(setup));
    int in_rounds = 0;
    for (int n = 0; n < 150; ++n) {
        run.advance();
        ASSERT_NEAR(run.mismatch(), largest_difference_from_contacts(run), 1e-12) << n;
        // Two grains, and what the contact solve itself leaves
        ASSERT_LE(run.contact_violation(), 2.01 * setup.joint_tolerance) << n;
        in_rounds += run.rounds() > 1 ? 1 : 0;
    }
    EXPECT_GT(run.contacts(), 100);
    EXPECT_GT(in_rounds, 3);
}

INSTANTIATE_TEST_SUITE_P(Splittings, JointWindow,
                         testing::Values("explicit-multiplier", "implicit-multiplier"),
                         [](const auto& info) {
                             std::string name = info.param;
                             name[name.find('-')] = '_';
                             return name;
                         });

}  // namespace
}  // namespace turbidite
