// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Static and sliding friction of a block (a disc that cannot rotate) on a tilted plane: mu_s = 0.5,
// mu_d = 0.3, g = 1.
#include <gtest/gtest.h>

#include <optional>

#include "scenes.hpp"

namespace turbidite::nscd {
namespace {

constexpr double mu_s = 0.5, mu_d = 0.3, dt = 0.01;

/// On a plane of the block's own material, or with a friction of its own instead.
Engine block_on_slope(double slope, double speed, std::optional<double> friction = std::nullopt) {
    EngineSettings settings = scenes::exact(mu_d, 1e-13);
    settings.gravity = scenes::tilted(std::atan(slope));
    settings.law.friction = "static-dynamic";
    Surface surface;
    surface.friction = mu_d;
    surface.static_friction = mu_s;
    settings.surfaces = {surface};
    Wall plane = scenes::floor(friction.value_or(0.0));
    plane.material = friction ? -1 : 0;
    Engine engine(settings, scenes::discs, {plane});
    engine.bodies().add(scenes::disc(1, 0.0, 0.5));
    engine.bodies().rotation_blocked[0] = 1;
    engine.bodies().twist[0].velocity = {speed, 0.0, 0.0};
    return engine;
}

double speed_after(Engine& engine, double time) {
    EXPECT_TRUE(scenes::run(engine, time, dt));
    return engine.bodies().twist[0].velocity[0];
}

TEST(StaticDynamic, HoldsUpToTheStaticCoefficient) {
    Engine engine = block_on_slope(0.999 * mu_s, 0.0);
    EXPECT_NEAR(speed_after(engine, 1.0), 0.0, 1e-13);
}

// A wall with a friction of its own has the static one in the same ratio: none at all if it is
// smooth, 0.1 with 0.06, and the block's own with the block's own.
TEST(StaticDynamic, AWallWithItsOwnFrictionHoldsInProportion) {
    const double slope = 0.05, alpha = std::atan(slope);
    Engine smooth = block_on_slope(slope, 0.0, 0.0);
    EXPECT_NEAR(speed_after(smooth, 1.0), std::sin(alpha), 1e-12);
    Engine holds = block_on_slope(0.099, 0.0, 0.06);
    EXPECT_NEAR(speed_after(holds, 1.0), 0.0, 1e-13);
    Engine slides = block_on_slope(0.101, 0.0, 0.06);
    EXPECT_GT(speed_after(slides, 1.0), 0.03);
    Engine own = block_on_slope(0.999 * mu_s, 0.0, mu_d);
    EXPECT_NEAR(speed_after(own, 1.0), 0.0, 1e-13);
}

// It begins to slide: one step with the static coefficient, all others with the sliding one.
TEST(StaticDynamic, SlidesWithTheLowerOneOnceItGaveWay) {
    const double slope = 1.001 * mu_s, alpha = std::atan(slope);
    Engine engine = block_on_slope(slope, 0.0);
    const double first = std::sin(alpha) - mu_s * std::cos(alpha);
    const double later = std::sin(alpha) - mu_d * std::cos(alpha);
    EXPECT_NEAR(speed_after(engine, 1.0), dt * (first + 99 * later), 1e-12);
}

// The same slope with an initial velocity: it never stops.
TEST(StaticDynamic, AMovingBlockDoesNotStopBetweenTheTwo) {
    const double alpha = std::atan(0.4);
    Engine engine = block_on_slope(0.4, 0.01);
    EXPECT_NEAR(speed_after(engine, 1.0), 0.01 + std::sin(alpha) - mu_d * std::cos(alpha), 1e-12);
}

// On a level plane: decelerates at mu_d g from 0.1, stops after 1/3, and then withstands a force of
// 0.49 weights.
TEST(StaticDynamic, SticksAgainAfterItStopped) {
    Engine engine = block_on_slope(0.0, 0.1);
    EXPECT_NEAR(speed_after(engine, 0.2), 0.1 - 0.2 * mu_d, 1e-12);
    EXPECT_NEAR(speed_after(engine, 0.3), 0.0, 1e-13);
    engine.bodies().force[0] = {0.49 * engine.bodies().mass[0], 0.0, 0.0};
    EXPECT_NEAR(speed_after(engine, 1.0), 0.0, 1e-13);
    engine.bodies().force[0] = {0.51 * engine.bodies().mass[0], 0.0, 0.0};
    EXPECT_NEAR(speed_after(engine, 1.0), 0.01 * (0.51 - mu_s) + 0.99 * (0.51 - mu_d), 1e-12);
}

// Whether a contact sticks is part of the state.
TEST(StaticDynamic, StateSurvivesARestart) {
    Engine engine = block_on_slope(0.4, 0.01);
    scenes::run(engine, 0.1, dt);
    Engine second = block_on_slope(0.4, 0.0);
    second.restore(engine.save());
    EXPECT_EQ(speed_after(second, 0.5), speed_after(engine, 0.5));
    Engine stuck = block_on_slope(0.4, 0.0);
    stuck.restore(engine.save());
    stuck.bodies().twist[0] = {};
    const double alpha = std::atan(0.4);
    EXPECT_NEAR(speed_after(stuck, dt), dt * (std::sin(alpha) - mu_d * std::cos(alpha)), 1e-13)
        << "it slid in the last step, so the first step has the lower coefficient";
}

TEST(StaticDynamic, RefusesAStaticCoefficientBelowTheOther) {
    EngineSettings settings;
    settings.law.friction = "static-dynamic";
    Surface surface;
    surface.friction = 0.3;
    settings.surfaces = {surface};
    EXPECT_THROW(Engine(settings, scenes::discs, {}), std::invalid_argument);
}

}  // namespace
}  // namespace turbidite::nscd
