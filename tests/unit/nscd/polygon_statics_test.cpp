// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include "coupler/rigid/vec3.hpp"
#include "polygon_reference.hpp"
#include "polygons.hpp"

namespace turbidite::nscd {
namespace {

constexpr double dt = 0.01;
const ShapeTable squares = {scenes::square_record()};

Engine block_on_incline(double friction, double alpha) {
    EngineSettings settings = scenes::exact(friction);
    settings.gravity = scenes::tilted(alpha);
    Engine engine(settings, squares, {scenes::floor(friction)});
    engine.bodies().add(scenes::unit_square(squares, 1, 0.0, 0.5));
    return engine;
}

// A block sticks as long as tan(alpha) <= mu, and beyond slides at g (sin - mu cos).
TEST(Block, SticksOrSlidesOnAnIncline) {
    Engine stuck = block_on_incline(0.3, std::atan(0.299));
    scenes::run(stuck, 1.0, dt);
    EXPECT_NEAR(stuck.bodies().position[0][0], 0.0, 1e-9);
    const double alpha = std::atan(0.5);
    Engine sliding = block_on_incline(0.3, alpha);
    scenes::run(sliding, 1.0, dt);
    const double acceleration = std::sin(alpha) - 0.3 * std::cos(alpha);
    EXPECT_NEAR(sliding.bodies().twist[0].velocity[0], acceleration, 1e-9);
    EXPECT_NEAR(sliding.bodies().twist[0].spin[2], 0.0, 1e-9);
}

// With enough friction a square tips when the line of its weight leaves its base: tan(alpha) > 1.
TEST(Block, TipsBeyondItsBase) {
    Engine standing = block_on_incline(5.0, std::atan(0.99));
    scenes::run(standing, 0.5, dt);
    EXPECT_NEAR(standing.bodies().twist[0].spin[2], 0.0, 1e-9);
    Engine tipping = block_on_incline(5.0, std::atan(1.05));
    scenes::run(tipping, 0.5, dt);
    EXPECT_LT(tipping.bodies().twist[0].spin[2], -1e-3);
}

// Five squares on each other: they stand still, and the floor carries the weight.
TEST(Block, StackStandsStill) {
    Engine engine(scenes::exact(0.3), squares, {scenes::floor(0.3)});
    for (int i = 0; i < 5; ++i)
        engine.bodies().add(scenes::unit_square(squares, i, 0.05 * (i % 2), 0.5 + i));
    scenes::run(engine, 2.0, dt);
    double floor = 0.0;
    for (std::size_t k = 0; k < engine.points().size(); ++k)
        if (engine.points()[k].wall >= 0) floor += engine.impulses()[k].n;
    EXPECT_NEAR(floor, 5.0 * dt, 1e-9);
    for (int i = 0; i < 5; ++i) {
        EXPECT_NEAR(engine.bodies().position[i][0], 0.05 * (i % 2), 1e-8);
        EXPECT_NEAR(engine.bodies().position[i][1], 0.5 + i, 1e-8);
    }
    EXPECT_LT(engine.max_penetration(), 1e-8);
}

// Names of contact points persist: a standing stack that starts from the last impulses needs a
// small fraction of the sweeps of one that starts from zero.
TEST(Block, WarmStartSurvives) {
    Engine engine(scenes::exact(0.3, 1e-6), squares, {scenes::floor(0.3)});
    for (int i = 0; i < 5; ++i)
        engine.bodies().add(scenes::unit_square(squares, i, 0.05 * (i % 2), 0.5 + i));
    scenes::run(engine, 1.0, dt);
    std::int64_t warm = 0, cold = 0;
    for (int n = 0; n < 10; ++n) {
        const std::vector<char> state = engine.save();
        engine.memory().forget();
        cold += engine.step(dt).iterations;
        engine.restore(state);
        warm += engine.step(dt).iterations;
        engine.move(dt);
    }
    EXPECT_LT(5 * warm, cold);
}

ShapeTable six_shapes(unsigned seed) {
    std::mt19937_64 random(seed);
    ShapeTable shapes = {{"disc", {}}, {"triangle", {}}};
    for (int k = 0; k < 4; ++k) shapes.push_back(scenes::random_polygon(random));
    return shapes;
}

/// Grains with radii over two decades, at random positions that may overlap.
Engine strewn(unsigned seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> place(0.0, 6.0), exponent(0.0, 2.0), turn(0.0, 6.2);
    const ShapeTable shapes = six_shapes(seed);
    Engine engine(scenes::exact(0.3), shapes, {});
    for (int i = 0; i < 250; ++i) {
        const double radius = std::pow(10.0, -exponent(random));
        if (i % 6 == 0) {
            engine.bodies().add(scenes::disc(i, place(random), place(random), radius));
            continue;
        }
        engine.bodies().add(
            scenes::polygon(shapes, i % 6, i, place(random), place(random), radius, turn(random)));
    }
    return engine;
}

/// Over all pairs of polygons.
double deepest_overlap(const Engine& engine, const PlacedPolygons& polygons) {
    const Bodies& bodies = engine.bodies();
    double deepest = 0.0;
    for (int i = 0; i < int(bodies.size()); ++i)
        for (int j = 0; j < i; ++j) {
            if (bodies.shape[i] == 0 || bodies.shape[j] == 0) continue;
            const auto a = reference::outline(polygons[i], bodies.position[i]);
            const auto b = reference::outline(polygons[j], bodies.position[j]);
            deepest = std::max(deepest, -static_cast<double>(reference::gap(a, b)));
        }
    return deepest;
}

// The broad phase uses circumscribed circles, the narrow phase the shapes: no overlap is missed.
TEST(StrewnPolygons, NoOverlapOfAnySizeEscapes) {
    for (unsigned seed = 0; seed < 5; ++seed) {
        Engine engine = strewn(seed);
        std::vector<std::uint8_t> polygons_only;
        for (const std::int32_t shape : engine.bodies().shape) polygons_only.push_back(shape != 0);
        const PolygonShapes table(six_shapes(seed));
        const double expected = deepest_overlap(engine, PlacedPolygons(table, engine.bodies()));
        engine.keep(polygons_only);
        EXPECT_GT(expected, 0.1);
        EXPECT_NEAR(engine.max_penetration(), expected, 1e-8);
    }
}

// Momentum and angular momentum change by gravity alone, whatever the contacts do.
TEST(StrewnPolygons, ContactsConserveMomentum) {
    Engine engine = strewn(11);
    const Bodies& bodies = engine.bodies();
    engine.step(dt);
    Vec3 impulse{};
    double moment = 0.0;
    double size = 0.0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        impulse = impulse + bodies.contact_impulse[i];
        moment += bodies.contact_angular_impulse[i][2] +
                  cross(bodies.position[i], bodies.contact_impulse[i])[2];
        size += norm(bodies.contact_impulse[i]);
    }
    EXPECT_GT(size, 0.0);
    EXPECT_LT(norm(impulse), 1e-12 * size);
    EXPECT_LT(std::abs(moment), 1e-11 * size);
}

}  // namespace
}  // namespace turbidite::nscd
