// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What a state may differ from q + dt U by, and what not.
#include <gtest/gtest.h>

#include <cmath>

#include "coupler/hub/checks/motion_rule.hpp"
#include "coupler/protocol/failure.hpp"
#include "coupler/transport/loopback_channel.hpp"
#include "tests/unit/coupler/test_case.hpp"

namespace turbidite {
namespace {

constexpr double dt = 0.01;

Quaternion about_z(double angle) {
    return {std::cos(0.5 * angle), 0.0, 0.0, std::sin(0.5 * angle)};
}

GrainState moved(GrainState grain, double x, double y) {
    grain.position[0] += x, grain.position[1] += y;
    return grain;
}

/// Three discs at x = 2, 4.5 and 7 that have gone through a window as the rule wants it.
class MotionRuleTest : public testing::Test {
 protected:
    Settings settings = test_settings();
    std::vector<GrainState> population = test_population();
    bool substeps = false, responses = false;
    Motion before, state;
    WindowResult result;
    std::vector<Leaver> leavers;

    void SetUp() override {
        for (GrainState& grain : population) grain.velocity = {0.3, -0.2, 0.0};
        play();
    }

    /// Fills the messages of an honest window of this population.
    void play() {
        before.grains = result.motion.grains = state.grains = population;
        for (std::size_t i = 0; i < population.size(); ++i) {
            GrainState& grain = state.grains[i];
            result.motion.grains[i].velocity[1] -= 0.01;
            grain.velocity[1] -= 0.02;
            grain.angular_velocity[2] = 0.7;
            grain = moved(grain, dt * grain.velocity[0], dt * grain.velocity[1]);
            grain.orientation = about_z(dt * 0.7);
        }
    }

    /// The refusal, empty if there is none; fills `defect`.
    std::string refusal() {
        MotionRule rule(settings, {{"disc", {}}}, population);
        rule.expect_substeps(substeps);
        rule.expect_responses(responses);
        auto [channel, ends] = LoopbackChannel::connect(2);
        const ParticipantLink link(Role::grains, *channel);
        const Arrival arrival(link, Kind::state, 5);
        const std::vector<int> owners(state.grains.size(), 1);
        const Window window{5, 5 * dt, dt, false};
        try {
            defect = rule.check_state(window, before, result, leavers, {state, owners, arrival});
        } catch (const PhysicsRefused& refused) {
            return refused.what();
        }
        return "";
    }

    void without_fluid() {
        result.motion.grains.clear();
        settings = test_settings("split", false);
    }
    /// Alone between free sides: nothing is near the second one.
    void keep_one() {
        for (auto* grains : {&before.grains, &result.motion.grains, &state.grains})
            *grains = {grains->at(1)};
    }

    GrainState& second() { return state.grains[1 % state.grains.size()]; }
    void push(double impulse) { second().contact_impulse = {impulse, 0.0, 0.0}; }

    MotionDefect defect;
};

TEST_F(MotionRuleTest, AnHonestWindowHasNoDefect) {
    EXPECT_EQ(refusal(), "");
    EXPECT_LT(defect.defect, 1e-15);
}

TEST_F(MotionRuleTest, TheOrientationHasNoSignAndDiscsTurn) {
    for (double& part : second().orientation) part = -part;
    EXPECT_EQ(refusal(), "");
    second().orientation = {1.0, 0.0, 0.0, 0.0};
    EXPECT_NE(refusal().find("grain 101 went from (4.5, 5, 0)"), std::string::npos) << refusal();
}

TEST_F(MotionRuleTest, CyclicSidesWrap) {
    for (const char* side : {"domain.left", "domain.right"})
        settings.set(side, std::string("cyclic"));
    second().position[0] += 10.0;
    EXPECT_EQ(refusal(), "");
    EXPECT_LT(defect.defect, 1e-14);
    second().position[1] += 10.0;
    EXPECT_NE(refusal(), "") << "bottom and top are walls";
}

TEST_F(MotionRuleTest, NamesProgramRankGrainAndWindow) {
    second().position[1] += 1e-6;
    const std::string text = refusal();
    for (const char* part : {"grains rank 1", "grain 101", "(4.5, 5, 0)", "which is 1e-06 from",
                             "\"state\" of window 5", "docs/write-an-adapter.md"})
        EXPECT_NE(text.find(part), std::string::npos) << part << "\nnot in\n" << text;
}

// U^{n+4/5} is 0.01 above U^{n+1}.
TEST_F(MotionRuleTest, ContactVelocitiesMoveGrainsOnlyWhereTheCaseSaysSo) {
    for (GrainState& grain : state.grains) grain = moved(grain, 0.0, dt * 0.01);
    EXPECT_NE(refusal(), "");
    responses = true;
    for (GrainState& grain : result.motion.grains) grain.angular_velocity[2] = 0.7;
    EXPECT_EQ(refusal(), "");
    EXPECT_LT(defect.defect, 1e-15);
    responses = false;
    settings.set("coupling.positions", std::string("contact"));
    EXPECT_EQ(refusal(), "");
}

// Place and turn may each be those of either velocity (docs/write-an-adapter.md).
TEST_F(MotionRuleTest, AGrainMayGoWithItsContactAndTurnWithItsKick) {
    for (GrainState& grain : state.grains) grain = moved(grain, 0.0, dt * 0.01);
    settings.set("coupling.positions", std::string("contact"));
    EXPECT_EQ(refusal(), "");  // place of U^{n+4/5}, turn of omega^{n+1}
    second().orientation = about_z(dt * 0.35);
    const std::string refused = refusal();
    EXPECT_NE(refused.find(", or those of its contacts, (0.3, -0.21, 0) and (0, 0, 0),"),
              std::string::npos)
        << refused;
}

// |U^{n+1} - U^{n+4/5}| = |U^{n+4/5} - U^n| = 0.01, R |d omega| = 0.35: 3.7e-3 and the overlap.
TEST_F(MotionRuleTest, OneStepPerWindowMovesWithAVelocityOfTheWindow) {
    push(0.01);
    state.report.max_penetration = 0.002;
    second().position[0] += 0.0056;
    EXPECT_EQ(refusal(), "");
    EXPECT_NEAR(defect.defect, 0.0056, 1e-12);
    EXPECT_EQ(defect.worst, 101);
    second().position[0] += 0.0003;
    EXPECT_NE(refusal(), "");
}

// 5 (dt V + overlap): the fastest point has |U| + R omega = 0.372 + 0.35, gravity adds 0.01.
TEST_F(MotionRuleTest, SubStepsMayLeaveAGrainWhereItsSpringsPutIt) {
    push(0.01);
    substeps = true;
    second().position[0] += 0.036;
    EXPECT_EQ(refusal(), "");
    second().position[0] += 0.002;
    EXPECT_NE(refusal(), "");
}

TEST_F(MotionRuleTest, WithoutAContactSubStepsEndWhereTheVelocityTakesThem) {
    substeps = true;
    second().position[0] += 1e-6;
    EXPECT_NE(refusal(), "");
    push(1e-15);  // what is left of a sum that cancels out
    EXPECT_NE(refusal(), "");
}

// Impulses from both sides may cancel out; only a grain with neighbours can have any.
TEST_F(MotionRuleTest, AGrainBetweenTwoMayBeSqueezed) {
    substeps = true;
    second().position[0] += 0.003;
    EXPECT_NE(refusal(), "");
    population[0].position[0] = 3.49, population[2].position[0] = 5.51;
    play();
    second().position[0] += 0.003;
    EXPECT_EQ(refusal(), "");
    second().position[0] += 5.0;
    EXPECT_NE(refusal(), "");
}

// In gravity alone they are at most dt |U^{n+1} - U^n| from q + dt U^{n+1}.
TEST_F(MotionRuleTest, DrySubStepsMayEndHalfAStepBehind) {
    without_fluid();
    for (GrainState& grain : state.grains) {
        grain.angular_velocity[2] = 0.0;
        grain.orientation = about_z(0.0);
    }
    second().position[1] += 0.5 * dt * 0.02;
    EXPECT_NE(refusal(), "");
    substeps = true;
    EXPECT_EQ(refusal(), "");
    second().position[1] += 0.6 * dt * 0.02;
    EXPECT_NE(refusal(), "");
}

TEST_F(MotionRuleTest, GrainsLeaveOnlyThroughAFreeSideAtWhichTheyAre) {
    leavers = {{102, 1}};
    state.grains.pop_back();
    EXPECT_NE(
        refusal().find("grain 102 was removed at (7, 5, 0), but no side of the domain is free"),
        std::string::npos)
        << refusal();
    settings.set("domain.right", std::string("free"));
    EXPECT_NE(refusal().find("3 from the nearest free side"), std::string::npos) << refusal();
    settings.set("run.size_x", 7.52);
    EXPECT_EQ(refusal(), "");
    settings.set("run.size_x", 6.4);  // its surface is beyond
    EXPECT_EQ(refusal(), "");
}

TEST_F(MotionRuleTest, AHeldGrainKeepsItsVelocity) {
    population[1].prescribed = true;
    population[1].velocity = {};
    play();
    EXPECT_NE(refusal().find("instead of the prescribed (0, 0, 0)"), std::string::npos);
    state.grains[1] = population[1];
    EXPECT_EQ(refusal(), "");
    push(1.0);  // the balances leave it out
    second().position[0] += 1e-6;
    EXPECT_NE(refusal(), "");
}

// x = 0.1 sin(2 pi t/T): in window 5 it has the mean velocity of the motion.
TEST_F(MotionRuleTest, ADrivenGrainFollowsItsMotion) {
    settings.set("run.grain_motions", std::string("101 harmonic 0.1 0 0 1 0"));
    population[1].prescribed = true;
    play();
    const double pi = std::acos(-1.0);
    const double u = 0.1 * (std::sin(2 * pi * 0.06) - std::sin(2 * pi * 0.05)) / dt;
    state.grains[1] = moved(population[1], dt * u, 0.0);
    state.grains[1].velocity = {u, 0.0, 0.0};
    EXPECT_EQ(refusal(), "");
    state.grains[1].velocity[0] *= 1.001;
    EXPECT_NE(refusal(), "");
}

}  // namespace
}  // namespace turbidite
