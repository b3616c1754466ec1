// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Laws between faces: unit squares of mass 1 on each other, the lower one fixed, without weight.
#include <gtest/gtest.h>

#include "coupler/rigid/vec3.hpp"
#include "polygons.hpp"

namespace turbidite::nscd {
namespace {

constexpr double c = 2.0, dt = 0.01;
const ShapeTable squares = {scenes::square_record()};

EngineSettings weightless(const Surface& surface, const LawChoice& law = {}) {
    EngineSettings settings = scenes::exact(0.0, 1e-12);
    settings.gravity = {};
    settings.surfaces = {surface};
    settings.law = law;
    settings.law_settings.adhesion_range = 0.05;
    settings.law_settings.adhesion_length = 0.02;
    settings.law_settings.adhesion_shear = 0.5;
    return settings;
}

Engine pair_of_squares(const EngineSettings& settings, double gap = 0.0) {
    Engine engine(settings, squares, {});
    engine.bodies().add(scenes::unit_square(squares, 1, 0.0, 0.5));
    engine.bodies().add(scenes::unit_square(squares, 2, 0.0, 1.5 + gap));
    engine.bodies().fixed[0] = 1;
    return engine;
}

double lifted(Engine& engine, double force, int steps) {
    engine.bodies().force[1] = {0.0, force, 0.0};
    EXPECT_TRUE(scenes::run(engine, steps * dt, dt));
    return engine.bodies().twist[1].velocity[1];
}

// Two points, one force: together they have the force that a pair of discs has at its single point,
// and the bond of a face of length 1 holds sigma_n.
TEST(FaceLaws, PointsShareTheForceOfAPair) {
    Surface sticky;
    sticky.friction = 0.0;
    sticky.adhesion = c;
    for (const char* adhesion : {"wet", "wet-irreversible", "cohesion"}) {
        LawChoice law;
        law.adhesion = adhesion;
        Engine holds = pair_of_squares(weightless(sticky, law));
        EXPECT_NEAR(lifted(holds, c * (1 - 1e-6), 20), 0.0, 1e-10) << adhesion;
        EXPECT_EQ(holds.points().size(), 2u);
        EXPECT_NEAR(holds.bodies().contact_impulse[1][1], -c * dt, 1e-7) << adhesion;
        Engine parts = pair_of_squares(weightless(sticky, law));
        EXPECT_NEAR(lifted(parts, c + 0.1, 1), 0.1 * dt, 1e-10) << adhesion;
        EXPECT_NEAR(parts.bodies().twist[1].spin[2], 0.0, 1e-10) << adhesion;
    }
}

// The bond of a face carries a moment. With a force F at a distance x = 1/2 it holds while the
// farther corner is under pressure, F (1/2 + x) <= c/2, with its points at the corners.
TEST(FaceLaws, BondsOfFacesCarryMoments) {
    Surface sticky;
    sticky.friction = 0.0;
    sticky.adhesion = c;
    LawChoice law;
    law.adhesion = "cohesion";
    for (const double force : {0.499 * c, 0.501 * c}) {
        Engine engine = pair_of_squares(weightless(sticky, law));
        engine.bodies().torque[1] = {0.0, 0.0, 0.5 * force};
        const double speed = lifted(engine, force, 1);
        EXPECT_EQ(std::abs(speed) > 1e-8, force > 0.5 * c) << speed;
    }
}

// Falls flat on the floor with speed 1: rebounds with e, without spin; friction has no effect.
TEST(FaceLaws, AFlatFallBouncesFlat) {
    for (const char* impact : {"newton", "moreau"}) {
        Surface surface;
        surface.friction = 0.4;
        surface.restitution = 0.7;
        LawChoice law;
        law.impact = impact;
        Engine engine = pair_of_squares(weightless(surface, law), 0.003);
        engine.bodies().twist[1].velocity = {0.0, -1.0, 0.0};
        engine.step(dt);
        EXPECT_NEAR(engine.bodies().twist[1].velocity[1], 0.7, 1e-10);
        EXPECT_NEAR(engine.bodies().twist[1].velocity[0], 0.0, 1e-10);
        EXPECT_NEAR(engine.bodies().twist[1].spin[2], 0.0, 1e-10);
    }
}

// A floor that rises at 1 under a square at rest: the square leaves at 1 + e.
TEST(FaceLaws, RestitutionIsRelativeToAMovingWall) {
    Surface surface;
    surface.restitution = 0.5;
    Wall floor = scenes::floor(0.3);
    floor.twist.velocity = {0.0, 1.0, 0.0};
    Engine engine(weightless(surface), squares, {floor});
    engine.bodies().add(scenes::unit_square(squares, 1, 0.0, 0.5));
    engine.step(dt);
    EXPECT_NEAR(engine.bodies().twist[0].velocity[1], 1.5, 1e-10);
}

}  // namespace
}  // namespace turbidite::nscd
