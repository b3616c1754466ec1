// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Walls and grains with the prescribed motions of a case, and grains of several materials, against
// motions derived by hand. Dry, g = 1, discs of diameter 1.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "granular_adapter/grains/wall_motions.hpp"
#include "granular_adapter/nscd_adapter/nscd_adapter.hpp"
#include "tests/unit/nscd_adapter/contact_case.hpp"

namespace turbidite {
namespace {

constexpr double step = 0.005;

Settings dry_box() {
    Settings settings = box_settings();
    settings.set("fluid.enabled", false);
    return settings;
}

/// Grains after `windows` windows without a fluid.
std::vector<GrainState> play(const Settings& settings, const std::vector<GrainState>& grains,
                             int windows) {
    NscdAdapter adapter;
    Motion motion = adapter.initialise(settings, {{"disc", {}}}, grains);
    for (int n = 0; n < windows; ++n) {
        Window window;
        window.index = n;
        window.time = n * step;
        window.step = step;
        adapter.advance(window, {});
        motion = adapter.apply_kick(window, {});
    }
    return motion.grains;
}

TEST(PrescribedMotion, KindsAreWhatTheySay) {
    Settings settings;
    settings.set("run.wall_motions", std::string("0 constant 1 -2 0.5;2 harmonic 0.1 0 0.2 4 0;"
                                                 "4 table 0 0 0 0 1 2 0 0 3 2 4 1"));
    const std::vector<Moved> moved = motions_of(settings, "run.wall_motions");
    ASSERT_EQ(moved.size(), 3u);
    EXPECT_EQ(moved[2].what, 4);
    EXPECT_DOUBLE_EQ(moved[0].motion->at(2.0).displacement[1], -4.0);
    EXPECT_DOUBLE_EQ(moved[0].motion->at(2.0).angle[2], 1.0);
    EXPECT_NEAR(moved[1].motion->at(1.0).displacement[0], 0.1, 1e-15);
    EXPECT_NEAR(moved[1].motion->at(3.0).angle[2], -0.2, 1e-15);
    EXPECT_DOUBLE_EQ(moved[2].motion->at(0.5).displacement[0], 1.0);
    EXPECT_DOUBLE_EQ(moved[2].motion->at(2.0).displacement[1], 2.0);
    EXPECT_DOUBLE_EQ(moved[2].motion->at(9.0).angle[2], 1.0);
}

TEST(PrescribedMotion, TextThatIsNoMotionIsRefused) {
    for (const char* text :
         {"0 circular 1 1 1", "0 harmonic 1 0", "0 table 0 0 0", "0 constant x"}) {
        Settings settings;
        settings.set("run.wall_motions", std::string(text));
        EXPECT_ANY_THROW(motions_of(settings, "run.wall_motions")) << text;
    }
}

// A sin(w t) with A w^2 = 0.41 g: the disc never leaves the floor.
TEST(PrescribedMotion, AGrainFollowsAShakenFloor) {
    Settings settings = dry_box();
    const double period = 2.0 * std::numbers::pi / 2.03;
    settings.set("run.wall_motions", "2 harmonic 0 0.1 0 " + std::to_string(period) + " 0");
    double highest = 0.0;
    for (const int windows : {150, 300, 450}) {
        const GrainState grain = play(settings, {grain_at(1, 5.0, 0.5)}, windows)[0];
        const double floor = 0.1 * std::sin(2.0 * std::numbers::pi * windows * step / period);
        EXPECT_NEAR(grain.position[1], 0.5 + floor, 1e-4);
        highest = std::max(highest, std::abs(floor));
    }
    EXPECT_GT(highest, 0.05);
}

// The right side moves in by 2 D and stops: what is in its way moves with it, and no farther.
TEST(PrescribedMotion, ASideOfTheBoxPushesAsItsTableSays) {
    Settings settings = dry_box();
    settings.set("contact.friction", 0.0);
    settings.set("run.wall_motions", std::string("1 table 0 0 0 0 1 -2 0 0"));
    const GrainState pushed = play(settings, {grain_at(1, 9.2, 0.5)}, 200)[0];
    EXPECT_NEAR(pushed.position[0], 10.0 - 2.0 - 0.5, 1e-4);
    EXPECT_NEAR(pushed.velocity[0], -2.0, 1e-6);
}

// A fixed grain cannot move out of the way.
TEST(PrescribedMotion, AGrainBeyondAMovedSideEndsTheRun) {
    Settings settings = dry_box();
    settings.set("run.wall_motions", std::string("1 table 0 0 0 0 1 -2 0 0"));
    GrainState fixed = grain_at(1, 9.2, 0.5);
    fixed.prescribed = true;
    EXPECT_NO_THROW(play(settings, {fixed}, 79));  // the side is at 9.21
    EXPECT_THROW(play(settings, {fixed}, 82), PhysicsRefused);
}

TEST(PrescribedGrain, KeepsItsVelocityAndPushesOthers) {
    Settings settings = dry_box();
    settings.set("contact.friction", 0.0);
    GrainState driven = grain_at(1, 2.0, 0.5), fixed = grain_at(3, 5.0, 10.0);
    driven.prescribed = fixed.prescribed = true;
    driven.velocity = {1.0, 0.0, 0.0};
    const auto grains = play(settings, {driven, grain_at(2, 3.5, 0.5), fixed}, 400);
    EXPECT_NEAR(grains[0].position[0], 4.0, 1e-12);
    EXPECT_NEAR(grains[0].position[1], 0.5, 1e-12);
    EXPECT_NEAR(grains[1].position[0], 5.0, 1e-4);  // in contact since t = 0.5
    EXPECT_TRUE(grains[0].prescribed);
    EXPECT_FALSE(grains[1].prescribed);
    EXPECT_EQ(grains[2].position[1], 10.0);  // stays where it was placed
}

/// Speed after t = 0.5 of a disc that slides over the floor from speed 1.
double speed_after_sliding(const Settings& settings, std::int32_t material) {
    GrainState grain = grain_at(1, 2.0, 0.5);
    grain.velocity = {1.0, 0.0, 0.0};
    grain.material = material;
    const GrainState after = play(settings, {grain}, 100)[0];
    EXPECT_EQ(after.material, material);
    return after.velocity[0];
}

// Sliding: v = 1 - mu g t. The floor is of the first material, mu = 0.3.
TEST(Materials, FrictionIsThatOfThePair) {
    Settings settings = dry_box();
    settings.set("run.materials", std::string("ice rubber"));
    settings.set("contact.materials.ice.friction", 0.0);
    settings.set("contact.materials.rubber.friction", 0.8);
    EXPECT_NEAR(speed_after_sliding(settings, 0), 0.85, 1e-3);
    EXPECT_NEAR(speed_after_sliding(settings, 1), 1.0, 1e-6);
    EXPECT_NEAR(speed_after_sliding(settings, 2), 0.85, 1e-3);  // the smaller of both
    settings.set("contact.pairs.default-ice.friction", 0.1);
    EXPECT_NEAR(speed_after_sliding(settings, 1), 0.95, 1e-3);
}

}  // namespace
}  // namespace turbidite
