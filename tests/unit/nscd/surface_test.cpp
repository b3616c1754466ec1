// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/laws/surface.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "scenes.hpp"

namespace turbidite::nscd {
namespace {

Surface rough(double friction, double restitution = 0.0) {
    Surface surface;
    surface.friction = friction;
    surface.restitution = restitution;
    return surface;
}

TEST(SurfaceTable, TakesTheSmallerOfTwo) {
    const SurfaceTable table({rough(0.2, 0.9), rough(0.5, 0.4)});
    EXPECT_EQ(table.pair(0, 1).friction, 0.2);
    EXPECT_EQ(table.pair(1, 0).friction, 0.2);
    EXPECT_EQ(table.pair(0, 1).restitution, 0.4);
    EXPECT_EQ(table.pair(1, 1).friction, 0.5);
    EXPECT_EQ(table.largest_restitution(), 0.9);
}

TEST(SurfaceTable, APairMayHaveValuesOfItsOwn) {
    const SurfaceTable table({rough(0.2), rough(0.5)}, {{1, 0, rough(0.7)}});
    EXPECT_EQ(table.pair(0, 1).friction, 0.7);
    EXPECT_EQ(table.pair(1, 0).friction, 0.7);
    EXPECT_EQ(table.pair(0, 0).friction, 0.2);
}

TEST(SurfaceTable, RefusesByName) {
    const auto refusal = [](const std::vector<Surface>& surfaces,
                            const std::vector<SurfacePair>& pairs = {}) -> std::string {
        try {
            const SurfaceTable table(surfaces, pairs);
        } catch (const std::invalid_argument& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_NE(refusal({rough(0.1), rough(-0.1)}).find("material 1: friction = -0.1"),
              std::string::npos);
    EXPECT_NE(refusal({rough(0.1, 1.5)}).find("restitution = 1.5"), std::string::npos);
    EXPECT_NE(refusal({rough(std::numeric_limits<double>::quiet_NaN())}).find("friction"),
              std::string::npos);
    EXPECT_NE(refusal({}).find("one material"), std::string::npos);
    EXPECT_NE(refusal({rough(0.1)}, {{0, 1, rough(0.1)}}).find("only 1"), std::string::npos);
    EXPECT_EQ(refusal({rough(0.1)}), "");
}

/// Speed after t = 1 of a block of a material on a slope of 0.35, g = 1.
double speed_on_slope(std::int32_t body, std::int32_t wall, double wall_friction = 0.0) {
    EngineSettings settings = scenes::exact(0.0, 1e-13);
    settings.gravity = scenes::tilted(std::atan(0.35));
    settings.surfaces = {rough(0.3), rough(0.4)};
    Wall plane = scenes::floor(wall_friction);
    plane.material = wall;
    Engine engine(settings, scenes::discs, {plane});
    Body block = scenes::disc(1, 0.0, 0.5);
    block.material = body;
    block.rotation_blocked = true;
    engine.bodies().add(block);
    scenes::run(engine, 1.0, 0.01);
    return engine.bodies().twist[0].velocity[0];
}

// On a slope of 0.35 a friction of 0.4 holds, and a friction of 0.3 gives an acceleration of sin -
// 0.3 cos. A wall without material has its own friction.
TEST(Surfaces, MaterialsOfBodyAndWallDecide) {
    const double alpha = std::atan(0.35), slides = std::sin(alpha) - 0.3 * std::cos(alpha);
    EXPECT_NEAR(speed_on_slope(1, 1), 0.0, 1e-13);
    EXPECT_NEAR(speed_on_slope(0, 1), slides, 1e-12);
    EXPECT_NEAR(speed_on_slope(1, 0), slides, 1e-12);
    EXPECT_NEAR(speed_on_slope(0, -1, 0.4), 0.0, 1e-13);
    EXPECT_NEAR(speed_on_slope(1, -1, 0.3), slides, 1e-12);
}

TEST(Surfaces, MayComeLate) {
    Engine engine(scenes::exact(0.3), scenes::discs, {scenes::floor(0.3)});
    engine.bodies().add(scenes::disc(1, 0.0, 0.5));
    engine.bodies().material[0] = 1;
    EXPECT_THROW(engine.step(0.01), std::invalid_argument);
    engine.set_surfaces({rough(0.3), rough(0.4)});
    EXPECT_NO_THROW(engine.step(0.01));
    EXPECT_THROW(engine.set_surfaces({rough(-1.0)}), std::invalid_argument);
    EXPECT_EQ(engine.surfaces().size(), 2) << "a refused table changes nothing";
}

// Materials are part of the state, restored with the bodies.
TEST(Surfaces, MaterialsSurviveRemovalAndRestart) {
    EngineSettings settings = scenes::exact(0.3);
    settings.surfaces = {rough(0.3), rough(0.4), rough(0.5)};
    Engine engine(settings, scenes::discs, {});
    for (int k = 0; k < 3; ++k) {
        Body body = scenes::disc(k, 2.0 * k, 0.0);
        body.material = k;
        engine.bodies().add(body);
    }
    engine.keep({1, 0, 1});
    Engine second(settings, scenes::discs, {});
    second.restore(engine.save());
    EXPECT_EQ(second.bodies().material, (std::vector<std::int32_t>{0, 2}));
}

}  // namespace
}  // namespace turbidite::nscd
