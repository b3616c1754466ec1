// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include "coupler/rigid/vec3.hpp"
#include "polygons.hpp"

namespace turbidite::nscd {
namespace {

constexpr double dt = 0.01;

Wall belt(double speed, double friction) {
    Wall wall = scenes::floor(friction);
    wall.twist.velocity = {speed, 0.0, 0.0};
    return wall;
}

// A disc placed on a belt slides at mu g and spins up at 2 mu g/R until the slip V - v - R w
// vanishes: after t = V/(3 mu g) it rolls with v = V/3, permanently.
TEST(Belt, DragsADiscToAThirdOfItsSpeed) {
    Engine engine(scenes::exact(0.2), scenes::discs, {belt(0.9, 0.2)});
    engine.bodies().add(scenes::disc(1, 0.0, 0.5));
    for (int n = 0; n < 300; ++n) {
        engine.step(dt);
        engine.move(dt);
        const double expected = std::min(0.2 * dt * (n + 1), 0.3);
        ASSERT_NEAR(engine.bodies().twist[0].velocity[0], expected, 1e-9) << n;
    }
    EXPECT_NEAR(engine.bodies().twist[0].spin[2], 2.0 * 0.3 / 0.5, 1e-8);
    EXPECT_NEAR(engine.walls()[0].point[0], 0.9 * 3.0, 1e-12);
}

// A block cannot roll: it accelerates at mu g = 0.2 until it moves with the belt.
TEST(Belt, CarriesABlockAlong) {
    const ShapeTable squares = {scenes::square_record()};
    Engine engine(scenes::exact(0.2), squares, {belt(0.5, 0.2)});
    engine.bodies().add(scenes::unit_square(squares, 1, 0.0, 0.5));
    for (int n = 0; n < 400; ++n) {
        engine.step(dt);
        engine.move(dt);
        ASSERT_NEAR(engine.bodies().twist[0].velocity[0], std::min(0.2 * dt * (n + 1), 0.5), 1e-9);
        ASSERT_NEAR(engine.bodies().twist[0].spin[2], 0.0, 1e-9);
    }
}

// A piston from the left collects three discs with gaps between them and pushes them at its own
// speed.
TEST(Piston, PushesWhatItMeets) {
    EngineSettings settings = scenes::exact(0.3);
    settings.gravity = {};
    Wall piston = scenes::wall(1, {0, 0, 0}, {1, 0, 0}, 0.3);
    piston.twist.velocity = {0.5, 0.0, 0.0};
    Engine engine(settings, scenes::discs, {piston});
    for (int i = 0; i < 3; ++i) engine.bodies().add(scenes::disc(i, 0.7 + 1.1 * i, 0.1 * i));
    double deepest = 0.0;
    for (int n = 0; n < 200; ++n) {
        engine.step(dt);
        engine.move(dt);
        deepest = std::max(deepest, engine.max_penetration());
    }
    EXPECT_NEAR(engine.walls()[0].point[0], 1.0, 1e-12);
    EXPECT_NEAR(engine.bodies().position[0][0], 1.5, 1e-9);
    for (int i = 0; i < 3; ++i) EXPECT_GT(engine.bodies().twist[i].velocity[0], 0.45);
    EXPECT_LT(deepest, 1e-4);
}

// Between a piston and a fixed wall there is no way out: the overlap grows with the piston's
// displacement, and the impulses stay finite and equal on both sides.
TEST(Piston, CompressesAgainstAWall) {
    EngineSettings settings = scenes::exact(0.3);
    settings.gravity = {};
    settings.solver_settings.max_iterations = 1000;
    Wall piston = scenes::wall(1, {0, 0, 0}, {1, 0, 0}, 0.3);
    piston.twist.velocity = {0.1, 0.0, 0.0};
    Engine engine(settings, scenes::discs, {piston, scenes::wall(2, {1.0, 0, 0}, {-1, 0, 0}, 0.3)});
    engine.bodies().add(scenes::disc(1, 0.5, 0.0));
    engine.step(dt);
    engine.move(dt);
    ASSERT_EQ(engine.impulses().size(), 2u);
    const double one = engine.impulses()[0].n, other = engine.impulses()[1].n;
    EXPECT_TRUE(std::isfinite(one));
    EXPECT_GT(one, 10.0 * 0.1 * engine.bodies().mass[0]);
    EXPECT_NEAR(other, one, 0.01 * one);
    EXPECT_NEAR(engine.max_penetration(), 0.001, 1e-6);
}

// A paddle spins at 2 about its end. A disc that lies on it at a distance of 0.6 must rise at 1.2,
// and the paddle has rotated by 2 dt after a step.
TEST(Paddle, LiftsAtSpinTimesArm) {
    EngineSettings settings = scenes::exact(0.0);
    settings.gravity = {};
    Wall paddle = scenes::floor(0.0);
    paddle.point = {0.5, 0.0, 0.0};
    paddle.half_length = 0.5;
    paddle.twist.spin = {0.0, 0.0, 2.0};
    Engine engine(settings, scenes::discs, {paddle});
    engine.bodies().add(scenes::disc(1, 0.6, 0.2, 0.2));
    engine.step(dt);
    EXPECT_NEAR(engine.bodies().twist[0].velocity[1], 1.2, 1e-9);
    engine.move(dt);
    EXPECT_NEAR(engine.walls()[0].point[0], 0.5 * std::cos(2.0 * dt), 1e-15);
    EXPECT_NEAR(engine.walls()[0].point[1], 0.5 * std::sin(2.0 * dt), 1e-15);
    EXPECT_NEAR(engine.walls()[0].normal[0], -std::sin(2.0 * dt), 1e-15);
}

/// A square that spins in a bed of discs.
Engine driven_bed(double spin = 1.0) {
    const ShapeTable shapes = {{"disc", {}}, scenes::square_record()};
    EngineSettings settings = scenes::exact(0.3, 1e-6);
    settings.solver_settings.max_iterations = 2000;
    Engine engine(settings, shapes,
                  {scenes::floor(0.3), scenes::wall(2, {0, 0, 0}, {1, 0, 0}, 0.3),
                   scenes::wall(3, {6, 0, 0}, {-1, 0, 0}, 0.3)});
    Body stirrer = scenes::polygon(shapes, 1, 100, 3.0, 2.0, 1.0);
    stirrer.fixed = true;
    stirrer.twist.spin = {0.0, 0.0, spin};
    engine.bodies().add(stirrer);
    int id = 0;
    for (int row = 0; row < 5; ++row)
        for (int column = 0; column < 9; ++column) {
            const double x = 0.35 + 0.65 * column, y = 0.35 + 0.65 * row;
            if (std::hypot(x - 3.0, y - 2.0) > 1.35)
                engine.bodies().add(scenes::disc(id++, x, y, 0.3));
        }
    return engine;
}

struct Stirring {
    double way = 0.0;      ///< displacement of all discs together, after the bed has settled
    double deepest = 0.0;  ///< largest overlap
};

Stirring stir(Engine& engine) {
    Stirring result;
    for (int n = 0; n < 400; ++n) {
        engine.step(dt);
        engine.move(dt);
        result.deepest = std::max(result.deepest, engine.max_penetration());
        for (std::size_t i = 1; i < engine.bodies().size(); ++i)
            if (n > 300) result.way += dt * norm(engine.bodies().twist[i].velocity);
    }
    return result;
}

// The spinning square keeps its motion whatever it meets, and moves the bed. Below its corners
// there is room for a disc, so that nothing is crushed.
TEST(DrivenBody, MovesABed) {
    Engine engine = driven_bed(), idle = driven_bed(0.0);
    const Stirring stirred = stir(engine), at_rest = stir(idle);
    EXPECT_EQ(engine.bodies().twist[0].spin[2], 1.0);
    EXPECT_EQ(engine.bodies().position[0][0], 3.0);
    EXPECT_NEAR(engine.bodies().orientation[0][3], std::sin(2.0), 1e-12);
    EXPECT_GT(stirred.way, 10.0 * at_rest.way);
    EXPECT_LT(stirred.deepest, 2e-3);
}

// Walls are part of the state, with and without the bodies.
TEST(DrivenBody, RestartsBitForBit) {
    const auto make = [] {
        Engine engine = driven_bed();
        engine.walls()[1].twist.velocity = {0.1, 0.0, 0.0};
        engine.walls()[0].twist.spin = {0.0, 0.0, 0.01};
        return engine;
    };
    Engine whole = make(), first = make(), second = make();
    scenes::run(whole, 0.6, dt);
    scenes::run(first, 0.3, dt);
    second.restore(first.save());
    EXPECT_EQ(second.save(), first.save());
    scenes::run(second, 0.3, dt);
    EXPECT_EQ(second.save(), whole.save());
    Engine third = make();
    third.bodies() = first.bodies();
    third.restore_memory(first.save_memory());
    scenes::run(third, 0.3, dt);
    EXPECT_EQ(third.save(), whole.save());
}

TEST(DrivenBody, RestoringNeedsTheSameWalls) {
    const Engine three = driven_bed();
    Engine one(scenes::exact(0.3), scenes::discs, {scenes::floor(0.3)});
    EXPECT_THROW(one.restore(three.save()), std::invalid_argument);
}

}  // namespace
}  // namespace turbidite::nscd
