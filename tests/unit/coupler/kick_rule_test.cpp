// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include "coupler/hub/kick_rule.hpp"
#include "tests/unit/coupler/test_case.hpp"

namespace turbidite {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double step = 0.01;

// One disc, R = 0.5, rho_s = 1.5, rho_f = 1: M = 1.5 pi/4, m_f = pi/4, M_eff = M_sub = pi/8, I_f =
// pi/32.
struct OneDisc {
    KickRule rule{run_values(test_settings()), {{"disc", {}}}};
    Motion before, contact;
    std::vector<Kick> kicks = std::vector<Kick>(1);

    OneDisc() {
        before.grains = {test_population()[0]};
        before.grains[0].velocity = {0.3, -0.2, 0.0};
        contact = before;
        kicks[0].id = before.grains[0].id;
    }
};

TEST(KickRule, ForceIsMultipliersPlusDisplacedInertia) {
    OneDisc disc;
    disc.kicks[0].velocity = {0.5, -0.2, 0.0};
    disc.kicks[0].angular_velocity = {0.0, 0.0, 2.0};
    disc.kicks[0].multiplier_impulse = {0.0, 0.04, 0.0};
    disc.rule.complete(disc.kicks, disc.before, step);
    EXPECT_NEAR(disc.kicks[0].force[0], pi / 4 * 0.2 / step, 1e-12);
    EXPECT_NEAR(disc.kicks[0].force[1], 4.0, 1e-12);
    EXPECT_NEAR(disc.kicks[0].torque[2], pi / 32 * 2.0 / step, 1e-12);
}

// Step 4: M_eff (U4 - Un) = M_sub g dt + Jc; step 5: M_eff (U1 - U4) = J. The balance must close.
TEST(KickRule, BalanceClosesForAConsistentWindowAndOnlyThen) {
    OneDisc disc;
    const double m_eff = pi / 8;
    disc.contact.grains[0].contact_impulse = {0.01, 0.02, 0.0};
    const Vec3 multiplier = {-0.005, 0.003, 0.0};
    disc.kicks[0].multiplier_impulse = multiplier;
    disc.kicks[0].velocity = {0.3 + (0.01 + multiplier[0]) / m_eff,
                              -0.2 - step + (0.02 + multiplier[1]) / m_eff, 0.0};
    disc.rule.complete(disc.kicks, disc.before, step);
    EXPECT_LT(disc.rule.balance(disc.kicks, disc.before, disc.contact, step).defect, 1e-14);

    disc.contact.grains[0].contact_impulse[0] = -0.01;  // a contact force without reaction
    EXPECT_GT(disc.rule.balance(disc.kicks, disc.before, disc.contact, step).defect, 0.1);
}

}  // namespace
}  // namespace turbidite
