// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The contact laws with spheres: impacts, friction, adhesion, moving walls.
#include <gtest/gtest.h>

#include "spheres.hpp"

namespace turbidite::nscd {
namespace {

constexpr double dt = 0.01;
const Vec3 oblique = (1.0 / 3.0) * Vec3{1.0, 2.0, -2.0};  // of length 1

EngineSettings weightless(const Surface& surface) {
    EngineSettings settings = scenes::exact_in_space(surface.friction, 1e-13);
    settings.gravity = {};
    settings.surfaces = {surface};
    settings.solver_settings.max_iterations = 1000;  // impulses near zero are rounding
    return settings;
}

Surface bouncy(double restitution, double friction = 0.0, double tangential = 0.0) {
    Surface surface;
    surface.friction = friction;
    surface.restitution = restitution;
    surface.restitution_tangential = tangential;
    return surface;
}

// Five spheres in a row, in any direction, with gaps; the first one moves. One impact after the
// other: with equal masses each passes on (1 + e)/2 of the speed and keeps (1 - e)/2.
TEST(SpaceLaws, NewtonsCradlePassesTheSpeedOn) {
    for (const double e : {1.0, 0.7, 0.0})
        for (const char* law : {"newton", "moreau"}) {
            EngineSettings settings = weightless(bouncy(e, 0.3));
            settings.law.impact = law;
            settings.theta = 0.5;
            Engine engine(settings, scenes::spheres, {});
            for (int i = 0; i < 5; ++i)
                engine.bodies().add(scenes::sphere(i + 1, 1.1 * i * oblique));
            engine.bodies().twist[0].velocity = 1.0 * oblique;
            // Up to the last impact, before slower ones behind are caught up by faster ones.
            double speed = 1.0;
            std::vector<double> expected;
            for (int i = 0; i < 4; ++i) {
                expected.push_back(0.5 * (1.0 - e) * speed);
                speed *= 0.5 * (1.0 + e);
            }
            expected.push_back(speed);
            int steps = 0;
            while (norm(engine.bodies().twist[4].velocity) == 0.0 && ++steps < 1000) {
                engine.step(dt);
                engine.move(dt);
            }
            ASSERT_LT(steps, 1000);
            if (e == 0.0) scenes::run(engine, 20 * dt, dt);
            for (std::size_t i = 0; i < 5; ++i) {
                const Twist& twist = engine.bodies().twist[i];
                // Without restitution they stay together.
                const double along = e > 0.0 ? expected[i] : 0.2;
                EXPECT_NEAR(dot(twist.velocity, oblique), along, 1e-10) << law << e << i;
                EXPECT_LT(norm(cross(twist.velocity, oblique)), 1e-12);
                EXPECT_LT(norm(twist.spin), 1e-12);
            }
        }
}

// A sphere on a rough plane, oblique, with spin: u_n^+ = -e u_n^-, and where it does not slide
// u_t^+ = -e_t u_t^-.
TEST(SpaceLaws, TangentialRestitutionIsOfBothDirections) {
    const double e = 0.6, e_t = 0.4;
    EngineSettings settings = weightless(bouncy(e, 10.0, e_t));
    Wall wall = scenes::wall(1, {}, oblique, 0.0);
    wall.material = 0;
    Engine engine(settings, scenes::spheres, {wall});
    engine.bodies().add(scenes::sphere(1, 0.5 * oblique));
    const Twist before{-1.0 * oblique + 0.3 * Vec3{2.0, -1.0, 0.0}, {0.5, -0.2, 0.9}};
    engine.bodies().twist[0] = before;
    engine.step(dt);
    const Twist& after = engine.bodies().twist[0];
    const Vec3 arm = -0.5 * oblique, u = before.at(arm), w = after.at(arm);
    const double un = dot(u, oblique), wn = dot(w, oblique);
    EXPECT_NEAR(wn, -e * un, 1e-12);
    const Vec3 slip = u - un * oblique, left = w - wn * oblique;
    EXPECT_GT(norm(slip), 0.3);
    EXPECT_GT(std::abs(engine.impulses()[0].t), 1e-3);
    EXPECT_GT(std::abs(engine.impulses()[0].s), 1e-3);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(left[i], -e_t * slip[i], 1e-12);
}

// Moreau's law: r_n >= 0 and friction hold for the averaged velocity; the energy does not grow.
void expect_no_gain(double rolling) {
    EngineSettings settings = scenes::exact_in_space(0.3, 1e-10);
    settings.surfaces = {bouncy(0.8, 0.3)};
    settings.surfaces[0].rolling_friction = settings.surfaces[0].torsion_friction = rolling;
    settings.law.impact = "moreau";
    settings.gravity = {};
    Engine engine = scenes::settling_spheres(4, 4, settings);
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (Twist& twist : engine.bodies().twist)
        twist = {{any(random), any(random), any(random)}, {any(random), any(random), any(random)}};
    double energy = scenes::kinetic_energy(engine.bodies());
    const double start = energy;
    for (int n = 0; n < 100; ++n) {
        EXPECT_TRUE(engine.step(dt).converged);
        const double now = scenes::kinetic_energy(engine.bodies());
        EXPECT_LE(now, energy * (1.0 + 1e-8)) << n;
        energy = now;
        engine.move(dt);
    }
    EXPECT_LT(energy, 0.9 * start);
    EXPECT_GT(energy, 0.05 * start);
}

TEST(SpaceLaws, MoreausLawDoesNotGainEnergy) {
    expect_no_gain(0.0);
    expect_no_gain(0.3);
}

/// A sphere that friction turns round and resistance to rolling then stops.
TEST(SpaceLaws, MoreausLawDoesNotGainEnergyByMoments) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> any(0.0, 1.0);
    int rolled = 0;
    for (int trial = 0; trial < 200; ++trial) {
        EngineSettings settings = scenes::exact_in_space(1.0, 1e-12);
        settings.surfaces = {bouncy(0.5 + 0.5 * any(random), 0.2 + any(random))};
        settings.surfaces[0].rolling_friction = 0.5 * any(random);
        settings.surfaces[0].torsion_friction = 0.5 * any(random);
        settings.law.impact = "moreau";
        settings.gravity = {};
        Wall wall = scenes::floor(0.0);
        wall.material = 0;
        Engine engine(settings, scenes::spheres, {wall});
        engine.bodies().add(scenes::sphere(1, {0.0, 0.5, 0.0}));
        engine.bodies().twist[0] = {{any(random), -5.0 * any(random), any(random)},
                                    {4.0 * any(random), any(random), 4.0 * any(random)}};
        const double before = scenes::kinetic_energy(engine.bodies());
        EXPECT_TRUE(engine.step(dt).converged);
        EXPECT_LE(scenes::kinetic_energy(engine.bodies()), before * (1.0 + 1e-10)) << trial;
        rolled += norm(world_moment(engine.impulses(), 0)) > 1e-3;
    }
    EXPECT_GT(rolled, 100);
}

// Two coefficients: held up to the static one in any direction, and once it gave way the sliding
// one; a sphere that cannot rotate, pulled by a force.
TEST(SpaceLaws, StaticFrictionHoldsInAnyDirection) {
    for (const double heading : {0.0, 0.7, 2.0})
        for (const double share : {0.999, 1.001}) {
            EngineSettings settings = scenes::exact_in_space(0.3, 1e-13);
            Surface surface = bouncy(0.0, 0.3);
            surface.static_friction = 0.5;
            settings.surfaces = {surface};
            settings.law.friction = "static-dynamic";
            Wall wall = scenes::floor(0.0);
            wall.material = 0;
            Engine engine(settings, scenes::spheres, {wall});
            engine.bodies().add(scenes::sphere(1, {0.0, 0.5, 0.0}));
            engine.bodies().rotation_blocked[0] = 1;
            const double weight = engine.bodies().mass[0];
            const Vec3 along{std::cos(heading), 0.0, std::sin(heading)};
            engine.bodies().force[0] = 0.5 * share * weight * along;
            EXPECT_TRUE(scenes::run(engine, 1.0, dt));
            const double expected =
                share < 1.0 ? 0.0 : dt * (0.5 * share - 0.5 + 99 * (0.5 * share - 0.3));
            EXPECT_NEAR(dot(engine.bodies().twist[0].velocity, along), expected, 1e-12);
        }
}

constexpr double c = 2.0, range = 0.05;

EngineSettings adhesive(const std::string& law) {
    Surface surface;
    surface.friction = 0.0;
    surface.adhesion = c;
    EngineSettings settings = weightless(surface);
    settings.law.adhesion = law;
    settings.law_settings.adhesion_range = range;
    settings.law_settings.adhesion_length = 0.02;
    settings.law_settings.adhesion_shear = 0.5;
    return settings;
}

/// A fixed sphere at the origin and a free one beyond a gap, along an oblique direction.
Engine pair_at(double gap, const EngineSettings& settings, double radius = 0.5) {
    Engine engine(settings, scenes::spheres, {});
    engine.bodies().add(scenes::sphere(1, {}));
    engine.bodies().add(scenes::sphere(2, (0.5 + radius + gap) * oblique, radius));
    engine.bodies().fixed[0] = 1;
    engine.bodies().rotation_blocked[1] = 1;
    return engine;
}

/// Speed of the free sphere along the pull after some steps.
double pulled(Engine& engine, double force, const Vec3& direction, int steps) {
    engine.bodies().force[1] = force * direction;
    EXPECT_TRUE(scenes::run(engine, steps * dt, dt));
    return dot(engine.bodies().twist[1].velocity, direction);
}

TEST(SpaceLaws, AdhesionHoldsUpToItsForce) {
    for (const char* law : {"wet", "wet-irreversible", "capillary", "cohesion"}) {
        EngineSettings settings = adhesive(law);
        settings.solver_settings.tolerance = 1e-6;
        Engine holds = pair_at(0.0, settings);
        pulled(holds, 0.0, oblique, 1);  // bridges form on contact
        EXPECT_NEAR(pulled(holds, c * (1 - 1e-6), oblique, 50), 0.0, 1e-12) << law;
        Engine parts = pair_at(0.0, settings);
        pulled(parts, 0.0, oblique, 1);
        EXPECT_GT(pulled(parts, c + 0.1, oblique, 50), 0.05) << law;
    }
}

// sqrt(R1 R2)/R exp(-g/lambda).
TEST(SpaceLaws, CapillaryForceFollowsItsCurve) {
    for (const double radius : {0.5, 0.25}) {
        Engine engine = pair_at(0.0, adhesive("capillary"), radius);
        pulled(engine, 0.0, oblique, 1);
        for (const double gap : {0.01, 0.03, 0.0499}) {
            engine.bodies().position[1] = (0.5 + radius + gap) * oblique;
            engine.bodies().twist[1] = {};
            engine.step(dt);
            const Vec3 force = (1.0 / dt) * engine.bodies().contact_impulse[1];
            const double expected = -c * std::sqrt(0.5 * radius) / 0.5 * std::exp(-gap / 0.02);
            EXPECT_NEAR(dot(force, oblique), expected, 1e-12) << gap;
            engine.move(dt, std::vector<Twist>(2));
        }
    }
}

// A bond of an area: c = sigma_n l^2, with l the smaller diameter and sigma_n the adhesion over the
// square of the reference diameter. Without normal load it bears shear up to half of it, in any
// direction of the tangent plane, and it breaks for good.
TEST(SpaceLaws, BondsHaveTheStrengthOfAnArea) {
    const double strength = c * 0.25;  // a diameter of 1/2
    for (const Vec3& direction : {oblique, (1.0 / std::sqrt(2.0)) * Vec3{0.0, 1.0, 1.0},
                                  (1.0 / std::sqrt(5.0)) * Vec3{2.0, -1.0, 0.0}}) {
        const double most = dot(direction, oblique) > 0.5 ? strength : 0.5 * strength;
        EXPECT_EQ(dot(direction, oblique) > 0.5 || std::abs(dot(direction, oblique)) < 1e-12, true);
        Engine holds = pair_at(0.0, adhesive("cohesion"), 0.25);
        EXPECT_NEAR(pulled(holds, 0.999 * most, direction, 20), 0.0, 1e-12);
        Engine breaks = pair_at(0.0, adhesive("cohesion"), 0.25);
        EXPECT_GT(pulled(breaks, 1.001 * most, direction, 20), 1e-3);
        const double speed = dot(breaks.bodies().twist[1].velocity, direction);
        const double mass = breaks.bodies().mass[1];
        EXPECT_NEAR(pulled(breaks, 0.1, direction, 1), speed + dt * 0.1 / mass, 1e-12)
            << "broken: nothing holds it";
    }
}

// A sphere placed on a belt slides at mu g and spins up at 5/2 mu g/R until the slip V - v - R w
// vanishes: after t = V/(3.5 mu g) it rolls with v = 2/7 V, permanently.
TEST(SpaceLaws, ABeltDragsASphereToTwoSeventhsOfItsSpeed) {
    Wall belt = scenes::floor(0.2);
    belt.twist.velocity = {0.6 * 0.7, 0.0, 0.8 * 0.7};
    Engine engine(scenes::exact_in_space(0.2), scenes::spheres, {belt});
    engine.bodies().add(scenes::sphere(1, {0.0, 0.5, 0.0}));
    for (int n = 0; n < 200; ++n) {
        engine.step(dt);
        engine.move(dt);
        const Vec3& v = engine.bodies().twist[0].velocity;
        const double expected = std::min(0.2 * dt * (n + 1), 0.2);
        ASSERT_NEAR(v[0], 0.6 * expected, 1e-9) << n;
        ASSERT_NEAR(v[2], 0.8 * expected, 1e-9) << n;
    }
    EXPECT_NEAR(norm(engine.bodies().twist[0].spin), 0.5 / 0.5, 1e-8);
    EXPECT_NEAR(engine.walls()[0].point[2], 0.8 * 0.7 * 2.0, 1e-12);
}

// A ball that rolls on a turntable without slip moves on a circle with 2/7 of the table's rate,
// wherever it started (Weltner 1979): here with speed 0.3, so of radius 3.5 * 0.3.
TEST(SpaceLaws, ABallOnATurntableMovesOnACircleWithTwoSeventhsOfItsRate) {
    constexpr double rate = 1.0, step = 0.001, speed = 0.3, radius = 0.5;
    Wall table = scenes::floor(50.0);
    table.twist.spin = {0.0, rate, 0.0};
    Engine engine(scenes::exact_in_space(50.0, 1e-9), scenes::spheres, {table});
    const Vec3 start{1.0, radius, 0.0};
    engine.bodies().add(scenes::sphere(1, start));
    // No slip: v + w x (-R e_y) = rate e_y x x.
    const Vec3 v{speed, 0.0, 0.0}, slip = cross({0.0, rate, 0.0}, start) - v;
    engine.bodies().twist[0] = {v, {-slip[2] / radius, 0.0, slip[0] / radius}};
    double farthest = 0.0;
    const long turn = std::lround(2.0 * std::numbers::pi * 3.5 / rate / step);
    for (long n = 0; n < turn; ++n) {
        engine.step(step);
        engine.move(step);
        farthest = std::max(farthest, norm(engine.bodies().position[0] - start));
    }
    EXPECT_NEAR(farthest, 2.0 * 3.5 * speed, 0.01);
    EXPECT_LT(norm(engine.bodies().position[0] - start), 0.02) << "a closed circle";
    EXPECT_NEAR(engine.bodies().position[0][1], radius, 1e-9);
}

// A piston pushes what it meets at its own speed; the bodies turn and slide on the way.
TEST(SpaceLaws, APistonPushesWhatItMeets) {
    EngineSettings settings = scenes::exact_in_space(0.3);
    settings.gravity = {};
    settings.solver_settings.max_iterations = 1000;  // impulses near zero are rounding
    Wall piston = scenes::wall(1, {}, oblique, 0.3);
    piston.twist.velocity = 0.5 * oblique;
    Engine engine(settings, scenes::spheres, {piston});
    for (int i = 0; i < 3; ++i)
        engine.bodies().add(scenes::sphere(i + 1, (0.7 + 1.1 * i) * oblique));
    double deepest = 0.0;
    for (int n = 0; n < 200; ++n) {
        engine.step(dt);
        engine.move(dt);
        deepest = std::max(deepest, engine.max_penetration());
    }
    EXPECT_LT(deepest, 1e-8);
    for (const Twist& twist : engine.bodies().twist)
        EXPECT_NEAR(dot(twist.velocity, oblique), 0.5, 1e-9);
}

// Bodies whose motion is prescribed push others, and take no momentum.
TEST(SpaceLaws, ADrivenSpherePushesAFreeOne) {
    EngineSettings settings = scenes::exact_in_space(0.3, 1e-12);
    settings.gravity = {};
    Engine engine(settings, scenes::spheres, {});
    engine.bodies().add(scenes::sphere(1, {}));
    engine.bodies().add(scenes::sphere(2, 1.2 * oblique));
    engine.bodies().fixed[0] = 1;
    engine.bodies().twist[0] = {0.5 * oblique, {0.0, 1.0, 0.0}};
    EXPECT_TRUE(scenes::run(engine, 1.0, dt));
    EXPECT_NEAR(dot(engine.bodies().twist[1].velocity, oblique), 0.5, 1e-9);
    EXPECT_EQ(engine.bodies().twist[0].spin[1], 1.0);
    EXPECT_GT(norm(cross(engine.bodies().twist[1].velocity, oblique)), 1e-3)
        << "friction of the turning one drags it aside";
}

}  // namespace
}  // namespace turbidite::nscd
