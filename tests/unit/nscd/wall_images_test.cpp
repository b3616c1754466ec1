// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Plates in a box with periodic sides. The box is 10 wide, and 8 high where its height repeats.
#include "granular_adapter/nscd/detection/wall_images.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "coupler/rigid/vec3.hpp"
#include "polygons.hpp"

namespace turbidite::nscd {
namespace {

constexpr double width = 10.0;
constexpr double dt = 0.01;

/// From (x1, y) to (x2, y).
Wall plate(double x1, double x2, double y, std::int32_t key = 4) {
    Wall wall = scenes::wall(key, {0.5 * (x1 + x2), y, 0.0}, {0.0, 1.0, 0.0}, 0.0);
    wall.half_length = 0.5 * (x2 - x1);
    wall.pivot = wall.point;
    return wall;
}

EngineSettings in_a_period() {
    EngineSettings settings = scenes::exact(0.0);
    settings.box.length = {width, 0.0, 0.0};
    return settings;
}

const ShapeTable shapes = {{"disc", {}}, scenes::square_record()};

Body square_at(double x, double y) {
    return scenes::polygon(shapes, 1, 1, x, y, std::sqrt(0.5));
}

Engine engine_with(const std::vector<Wall>& walls, const Body& body) {
    Engine engine(in_a_period(), shapes, walls);
    engine.bodies().add(body);
    return engine;
}

/// A disc and a square above the image of a plate's end fall on it and stay as long as it holds
/// their centre.
TEST(WallImages, HoldABodyOnTheOtherSideOfThePeriod) {
    for (const bool square : {false, true})
        for (const double x : {0.6, 9.6}) {
            Engine engine = engine_with({plate(8.0, 12.0, 3.0)},
                                        square ? square_at(x, 4.0) : scenes::disc(1, x, 4.0));
            scenes::run(engine, 3.0, dt);
            EXPECT_NEAR(engine.bodies().position[0][1], 3.5, 1e-6) << square << x;
            EXPECT_NEAR(engine.bodies().position[0][0], x, 1e-9) << square << x;
            EXPECT_GT(engine.bodies().contact_impulse[0][1], 0.0) << square << x;
        }
}

/// The end of a plate at the side is 0.2 from the path of a disc just beyond it, which it turns
/// aside.
TEST(WallImages, AnEndAtTheSideIsMetFromBeyond) {
    Engine engine = engine_with({plate(8.0, 10.0, 3.0)}, scenes::disc(1, 0.2, 5.0));
    bool touched = false;
    for (int n = 0; n < 300; ++n) {
        engine.step(dt);
        touched = touched || engine.bodies().contact_impulse[0][1] > 0.0;
        engine.move(dt);
        ASSERT_LT(engine.max_penetration_after_move(), 1e-9);
    }
    EXPECT_TRUE(touched);
    EXPECT_GT(engine.bodies().position[0][0], 0.3);
}

/// A disc that slides over the side keeps its contact and what the solver remembers of it.
TEST(WallImages, KeepTheContactOfABodyThatCrossesTheSide) {
    Body body = scenes::disc(1, 9.6, 3.5);
    body.twist.velocity = {1.0, 0.0, 0.0};
    Engine engine = engine_with({plate(8.0, 12.0, 3.0)}, body);
    for (int n = 0; n < 80; ++n) {
        const StepReport report = engine.step(dt);
        ASSERT_EQ(report.contacts, 1) << n;
        if (n > 0) {
            ASSERT_GT(engine.guess()[0].n, 0.0) << n;
        }
        engine.move(dt);
    }
    EXPECT_NEAR(engine.bodies().position[0][0], 0.4, 1e-9);
    EXPECT_NEAR(engine.bodies().position[0][1], 3.5, 1e-9);
}

/// A plate with a slope of about 1 : 10, longer than the period: its images are layers 1 apart,
/// with a disc that fits between two of them.
TEST(WallImages, TwoOfThemMayTouchOneBody) {
    const Vec3 normal{-0.1, std::sqrt(0.99), 0.0};
    Wall sloping = scenes::wall(4, {5.0, 3.0, 0.0}, normal, 0.0);
    sloping.half_length = 14.0;
    const Vec3 between = sloping.point - 0.5 * normal;
    for (const bool square : {false, true}) {
        Body body = scenes::disc(1, between[0], between[1]);
        if (square) body = square_at(between[0], between[1]);
        body.orientation = scenes::turned(std::asin(0.1));
        Engine engine = engine_with({sloping}, body);
        engine.step(dt);
        std::vector<std::int32_t> features;
        for (const ContactPoint& point : engine.points()) {
            EXPECT_NEAR(point.gap, 0.0, 1e-12);
            features.push_back(point.feature);
        }
        std::sort(features.begin(), features.end());
        EXPECT_EQ(features.size(), square ? 4u : 2u);
        EXPECT_EQ(std::unique(features.begin(), features.end()), features.end());
        EXPECT_NEAR(norm(engine.bodies().twist[0].velocity), 0.1 * dt, 1e-4);  // along the layers
    }
}

/// A paddle that turns beyond the side moves the bodies there with its own speed.
TEST(WallImages, TurnAboutTheirOwnPivots) {
    Wall paddle = plate(9.0, 11.0, 3.0);
    paddle.pivot = {9.0, 3.0, 0.0};
    paddle.twist.spin = {0.0, 0.0, 0.5};
    EngineSettings settings = in_a_period();
    settings.gravity = {};
    Engine engine(settings, shapes, {paddle});
    engine.bodies().add(scenes::disc(1, 0.5, 3.5));
    engine.step(1e-4);
    EXPECT_NEAR(engine.bodies().twist[0].velocity[1], 0.5 * 1.5, 1e-6);
}

/// Where nothing repeats there are no images, and far away none.
TEST(WallImages, AreThoseWithinReachOfTheBodies) {
    Bodies bodies;
    bodies.add(scenes::disc(1, 5.0, 3.0));
    PeriodicBox box;
    const std::vector<Wall> walls{scenes::floor(0.0), plate(8.0, 12.0, 3.0)};
    EXPECT_EQ(with_images(walls, bodies, box, 100.0).size(), 2u);
    box.length = {width, 0.0, 0.0};
    EXPECT_EQ(with_images(walls, bodies, box, 2.9).size(), 2u);
    const std::vector<Wall> near = with_images(walls, bodies, box, 3.1);
    ASSERT_EQ(near.size(), 3u);
    EXPECT_NEAR(near[2].point[0], 0.0, 1e-12);
    EXPECT_NEAR(near[2].pivot[0], 0.0, 1e-12);
    box.length = {width, 8.0, 0.0};
    EXPECT_EQ(with_images(walls, bodies, box, 8.0).size(), 2u + 5u);  // 2 x 3 places, one its own
}

/// A disc whose centre is the end of a plate touches it, whichever way its place along the plate is
/// rounded.
TEST(PlateEnd, TouchesAConcentricDisc) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    for (int n = 0; n < 1000; ++n) {
        const double angle = 3.0 * number(random);
        Wall wall = scenes::wall(4, {number(random), number(random), 0.0},
                                 {std::cos(angle), std::sin(angle), 0.0}, 0.0);
        wall.half_length = 0.1 + std::abs(number(random));
        const Vec3 end = wall.point + wall.half_length * Vec3{-wall.normal[1], wall.normal[0], 0.0};
        Engine engine(scenes::exact(0.0), shapes, {wall});
        engine.bodies().add(scenes::disc(1, end[0], end[1]));
        engine.step(dt);
        ASSERT_EQ(engine.points().size(), 1u) << n;
        EXPECT_NEAR(engine.points()[0].gap, -0.5, 1e-15);
    }
}

}  // namespace
}  // namespace turbidite::nscd
