// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <numbers>

#include "coupler/hub/kick_rule.hpp"
#include "tests/unit/coupler/test_case.hpp"

namespace turbidite {
namespace {

using std::numbers::pi;
constexpr double step = 0.01;

// One disc, R = 0.5, rho_s = 1.5, rho_f = 1: M = 1.5 pi/4, m_f = pi/4, M_eff = M_sub = pi/8, I_f =
// pi/32.
struct OneDisc {
    KickRule rule{run_values(test_settings()), {{"disc", {}}}, test_population()};
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

// A grain that moves with its fluid: what is left of the equation is rounding, and no defect; a
// force of a millionth of its momentum is one.
TEST(KickRule, OfAGrainOnWhichNothingActsRoundingIsNoDefect) {
    OneDisc disc;
    RunValues run = run_values(test_settings());
    run.gravity = 0.0;
    KickRule rule(run, {{"disc", {}}}, test_population());
    disc.kicks[0].velocity = disc.before.grains[0].velocity;
    disc.kicks[0].velocity[0] *= 1.0 + 2e-16;
    disc.kicks[0].angular_velocity = disc.before.grains[0].angular_velocity = {0.0, 0.0, 2.0};
    const auto defect = [&](const Vec3& multiplier) {
        disc.kicks[0].multiplier_impulse = multiplier;
        rule.complete(disc.kicks, disc.before, step);
        return rule.balance(disc.kicks, disc.before, disc.contact, step).defect;
    };
    EXPECT_LT(defect({}), 1e-8);
    EXPECT_GT(defect({0.0, 1e-6, 0.0}), 0.5);
}

// A sum that overflows is no number, and must not pass for the balance of the grains after it.
TEST(KickRule, ABalanceThatOverflowsIsNotForgotten) {
    OneDisc disc;
    Motion after = disc.before;
    after.grains[0].velocity = {1e308, 0.0, 0.0};
    disc.before.grains[0].velocity = {-1e308, 0.0, 0.0};
    after.grains[0].contact_impulse = {1e308, 0.0, 0.0};
    for (Motion* motion : {&disc.before, &after}) {
        motion->grains.push_back(motion->grains[0]);
        motion->grains[1].id += 1;
        motion->grains[1].velocity = motion->grains[1].contact_impulse = {};
    }
    EXPECT_FALSE(disc.rule.balance(disc.before, after, step).defect < 1.0);
}

// M (U1 - Un) = M g dt + Jc, I (w1 - wn) = Kc.
TEST(KickRule, BalanceWithoutAFluid) {
    OneDisc disc;
    const double mass = 1.5 * pi / 4, inertia = mass / 8;
    Motion after = disc.before;
    GrainState& grain = after.grains[0];
    grain.contact_impulse = {0.01, 0.02, 0.0};
    grain.contact_angular_impulse = {0.0, 0.0, 0.003};
    grain.velocity = {0.3 + 0.01 / mass, -0.2 - step + 0.02 / mass, 0.0};
    grain.angular_velocity = {0.0, 0.0, 0.003 / inertia};
    EXPECT_LT(disc.rule.balance(disc.before, after, step).defect, 1e-14);

    grain.contact_angular_impulse[2] = 0.0;
    const GrainBalance found = disc.rule.balance(disc.before, after, step);
    EXPECT_GT(found.defect, 0.1);
    EXPECT_EQ(found.worst, grain.id);
    EXPECT_EQ(found.rule, GrainBalance::Rule::dry);

    after.grains.clear();  // it has left
    EXPECT_EQ(disc.rule.balance(disc.before, after, step).defect, 0.0);
}

TEST(KickRule, TheStateMustBeThatOfTheKicksAndTheContacts) {
    OneDisc disc;
    disc.kicks[0].velocity = disc.before.grains[0].velocity;
    const GrainBalance good{0.0, 0, GrainBalance::Rule::wet, 0.5};
    Motion state = disc.contact;
    EXPECT_EQ(disc.rule.with_state(good, disc.kicks, disc.contact, state).defect, 0.0);

    state.grains[0].contact_impulse[0] = 0.001;
    const GrainBalance found = disc.rule.with_state(good, disc.kicks, disc.contact, state);
    EXPECT_NEAR(found.defect, 0.001 / 0.5, 1e-15);
    EXPECT_EQ(found.rule, GrainBalance::Rule::state);

    const GrainBalance worse{0.1, 7, GrainBalance::Rule::wet, 0.5};
    EXPECT_EQ(disc.rule.with_state(worse, disc.kicks, disc.contact, state).worst, 7);
}

// Whose motion is given, the population says: no message can take a grain out of the balances.
TEST(KickRule, AGrainThatCallsItselfPrescribedIsBalancedAllTheSame) {
    OneDisc disc;
    disc.before.grains[0].prescribed = disc.contact.grains[0].prescribed = true;
    disc.contact.grains[0].contact_impulse[0] = 0.01;
    disc.kicks[0].velocity = disc.before.grains[0].velocity;
    disc.rule.complete(disc.kicks, disc.before, step);
    EXPECT_GT(disc.rule.balance(disc.kicks, disc.before, disc.contact, step).defect, 0.1);
    EXPECT_GT(disc.rule.balance(disc.before, disc.contact, step).defect, 0.1);
    Motion state = disc.contact;
    state.grains[0].contact_impulse[0] = 0.0;
    const GrainBalance good{0.0, 0, GrainBalance::Rule::wet, 0.5};
    EXPECT_NEAR(disc.rule.with_state(good, disc.kicks, disc.contact, state).defect, 0.01 / 0.5,
                1e-15);
}

TEST(KickRule, AGrainThatThePopulationPrescribesIsLeftOut) {
    OneDisc disc;
    std::vector<GrainState> population = test_population();
    population[0].prescribed = true;
    KickRule rule(run_values(test_settings()), {{"disc", {}}}, population);
    disc.contact.grains[0].contact_impulse[0] = 0.01;
    disc.kicks[0].velocity = disc.before.grains[0].velocity;
    rule.complete(disc.kicks, disc.before, step);
    EXPECT_EQ(rule.balance(disc.kicks, disc.before, disc.contact, step).defect, 0.0);
    EXPECT_EQ(rule.balance(disc.before, disc.contact, step).defect, 0.0);
}

}  // namespace
}  // namespace turbidite
