// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Spheres that roll in round walls, and walls that move: periods, what is conserved, what a turning
// wall carries along.
#include <gtest/gtest.h>

#include "round_walls.hpp"

namespace turbidite::nscd {
namespace {

constexpr double tube_radius = 5.0, radius = 0.5;

/// At an angle from the lowest place of a tube around z.
Body at_angle(double angle) {
    const double arm = tube_radius - radius;
    return scenes::sphere(1, {arm * std::sin(angle), -arm * std::cos(angle), 0.0}, radius);
}

/// Time between the first two passages of the lowest place in the same direction.
double period_in_a_tube(double friction) {
    Engine engine(scenes::exact_in_space(friction), scenes::spheres,
                  {scenes::tube(tube_radius, 4.0, friction)});
    engine.bodies().add(at_angle(0.03));
    const double dt = 0.002;
    std::vector<double> passages;
    for (int n = 0; passages.size() < 2 && n < 20000; ++n) {
        const double before = engine.bodies().position[0][0];
        engine.step(dt);
        engine.move(dt);
        const double after = engine.bodies().position[0][0];
        if (before > 0.0 && after <= 0.0) passages.push_back(dt * (n + before / (before - after)));
    }
    return passages.size() == 2 ? passages[1] - passages[0] : 0.0;
}

TEST(SpaceWallMotion, ASphereOscillatesInATube) {
    const double sliding = 2.0 * std::numbers::pi * std::sqrt(tube_radius - radius);
    EXPECT_NEAR(period_in_a_tube(0.0) / sliding, 1.0, 1e-3);
    EXPECT_NEAR(period_in_a_tube(0.5) / (sliding * std::sqrt(7.0 / 5.0)), 1.0, 1e-3);
}

/// Without friction the wall's force meets the axis.
TEST(SpaceWallMotion, AConeKeepsTheAngularMomentumAboutItsAxis) {
    Engine engine(scenes::exact_in_space(0.0), scenes::spheres,
                  {scenes::round_wall(6, {}, {0, 1, 0}, {0.5, 0.0}, {8.5, 8.0})});
    Body sphere = scenes::sphere(1, {3.0, 3.5, 0.0}, radius);
    sphere.twist.velocity = {0.0, 0.0, 2.0};
    engine.bodies().add(sphere);
    const auto momentum = [&] {
        const auto& b = engine.bodies();
        return cross(b.position[0], b.twist[0].velocity)[1];
    };
    const double before = momentum();
    int touching = 0;
    for (int n = 0; n < 2000; ++n) {
        touching += engine.step(0.005).contacts > 0;
        engine.move(0.005);
        ASSERT_NEAR(momentum(), before, 1e-11);
        ASSERT_LT(engine.max_penetration(), 1e-3);
    }
    EXPECT_GT(touching, 1500);
}

/// At the bottom of a turning drum a sphere rolls on the spot: its surface follows the drum's.
TEST(SpaceWallMotion, ATurningDrumSpinsASphere) {
    Wall drum = scenes::tube(tube_radius, 4.0, 0.5);
    drum.twist.spin = {0.0, 0.0, 0.2};
    Engine engine(scenes::exact_in_space(0.5), scenes::spheres, {drum});
    Body sphere = at_angle(0.0);
    sphere.twist.spin = {0.0, 0.0, 0.2 * tube_radius / radius};
    engine.bodies().add(sphere);
    scenes::run(engine, 5.0, 0.005);
    EXPECT_NEAR(engine.bodies().position[0][0], 0.0, 1e-9);
    EXPECT_NEAR(engine.bodies().twist[0].spin[2], 0.2 * tube_radius / radius, 1e-9);
    engine.bodies().twist[0].spin = {};
    scenes::run(engine, 0.05, 0.005);
    // A sphere that does not spin is carried up, in the direction of the drum at its bottom.
    EXPECT_GT(engine.bodies().twist[0].velocity[0], 0.02);
    EXPECT_GT(engine.bodies().contact_impulse[0][0], 0.0);
}

/// Without weight a sphere turns with the drum, held on its circle by the wall alone.
TEST(SpaceWallMotion, ASphereTurnsWithADrum) {
    const double spin = 1.0, arm = tube_radius - radius, dt = 0.002;
    EngineSettings settings = scenes::exact_in_space(0.5);
    settings.gravity = {};
    Wall drum = scenes::tube(tube_radius, 4.0, 0.5);
    drum.twist.spin = {0.0, 0.0, spin};
    Engine engine(settings, scenes::spheres, {drum});
    Body sphere = at_angle(0.0);
    sphere.twist = {{spin * arm, 0.0, 0.0}, {0.0, 0.0, spin}};
    engine.bodies().add(sphere);
    scenes::run(engine, std::numbers::pi, dt);
    EXPECT_NEAR(engine.bodies().position[0][1], arm, 0.02);
    EXPECT_NEAR(norm(engine.bodies().position[0]), arm, 1e-4);
    EXPECT_NEAR(engine.bodies().twist[0].spin[2], spin, 1e-2);
    const double force = norm(engine.bodies().contact_impulse[0]) / dt;
    EXPECT_NEAR(force / (engine.bodies().mass[0] * spin * spin * arm), 1.0, 0.01);
}

/// A paddle that turns about its edge pushes a sphere ahead of it and leaves nothing behind.
TEST(SpaceWallMotion, ARectangleTurnsWithItsSide) {
    Wall paddle = scenes::rectangle(6, {2.0, 0.0, 0.0}, {0, 1, 0}, {1, 0, 0}, 2.0, 1.0);
    paddle.pivot = {};
    paddle.twist.spin = {0.0, 0.0, 0.5};
    EngineSettings settings = scenes::exact_in_space(0.0);
    settings.gravity = {};
    Engine engine(settings, scenes::spheres, {paddle});
    engine.bodies().add(scenes::sphere(1, {2.0, 0.6, 0.0}));
    scenes::run(engine, 1.0, 0.002);
    const Wall& now = engine.walls()[0];
    EXPECT_NEAR(now.side[0], std::cos(0.5), 1e-12);
    EXPECT_NEAR(now.side[1], std::sin(0.5), 1e-12);
    EXPECT_NEAR(now.point[1], 2.0 * std::sin(0.5), 1e-12);
    EXPECT_GT(engine.bodies().twist[0].velocity[1], 0.8);
    EXPECT_LT(engine.max_penetration(), 1e-5);  // 2 m (0.5 dt)^2 and what the sphere slides
}

TEST(SpaceWallMotion, AWallThatMovesIsRestored) {
    Wall paddle = scenes::rectangle(6, {}, {0, 1, 0}, {1, 0, 0}, 2.0, 1.0);
    paddle.twist.spin = {0.3, 0.0, 0.5};
    Engine engine(scenes::exact_in_space(0.3), scenes::spheres, {paddle});
    engine.bodies().add(scenes::sphere(1, {0.0, 0.6, 0.0}));
    scenes::run(engine, 0.5, 0.01);
    Engine again(scenes::exact_in_space(0.3), scenes::spheres, {paddle});
    again.restore(engine.save());
    for (Engine* each : {&engine, &again}) scenes::run(*each, 0.5, 0.01);
    EXPECT_EQ(engine.bodies().position, again.bodies().position);
    EXPECT_EQ(engine.walls()[0].side, again.walls()[0].side);
    EXPECT_NE(engine.walls()[0].side, paddle.side);
}

}  // namespace
}  // namespace turbidite::nscd
