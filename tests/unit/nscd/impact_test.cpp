// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Impacts without restitution.
#include <gtest/gtest.h>

#include <random>

#include "coupler/rigid/vec3.hpp"
#include "scenes.hpp"

namespace turbidite::nscd {
namespace {

EngineSettings weightless(double friction) {
    EngineSettings settings = scenes::exact(friction, 1e-13);
    settings.gravity = {};
    return settings;
}

// Dropped from y = 1 (gap 1/2) with g = 1: lands after t = 1, never rises, and comes to rest on the
// floor.
TEST(Impact, DiscDoesNotRebound) {
    for (const double dt : {0.02, 0.01, 0.005}) {
        Engine engine(scenes::exact(0.3), scenes::discs, {scenes::floor(0.3)});
        engine.bodies().add(scenes::disc(1, 0.0, 1.0));
        double impulse = 0.0;
        for (int n = 0; n * dt < 1.5; ++n) {
            engine.step(dt);
            impulse += engine.bodies().contact_impulse[0][1];
            EXPECT_LE(engine.bodies().twist[0].velocity[1], 1e-12);
            engine.move(dt);
        }
        EXPECT_NEAR(engine.bodies().position[0][1], 0.5, 1e-12);
        EXPECT_NEAR(engine.bodies().twist[0].velocity[1], 0.0, 1e-12);
        // From rest to rest: the floor returns the whole weight, m g 1.5.
        EXPECT_NEAR(impulse, std::numbers::pi / 4 * 1.5, std::numbers::pi / 4 * dt);
    }
}

// A gap of 0.3 u dt closes within the step: the velocity 0.3 u moves the disc exactly to the floor.
TEST(Impact, GapIsUsedUpToTheLast) {
    Engine engine(weightless(0.0), scenes::discs, {scenes::floor(0.0)});
    engine.bodies().add(scenes::disc(1, 0.0, 0.503));
    engine.bodies().twist[0].velocity = {0.0, -1.0, 0.0};
    engine.step(0.01);
    EXPECT_NEAR(engine.bodies().twist[0].velocity[1], -0.3, 1e-12);
    engine.move(0.01);
    EXPECT_NEAR(engine.max_penetration(), 0.0, 1e-15);
    engine.step(0.01);
    EXPECT_NEAR(engine.bodies().twist[0].velocity[1], 0.0, 1e-12);
}

// Velocity (1, 0, 0) against three touching equal discs, e = 0: they continue together at 1/3.
TEST(Impact, ChainSharesItsMomentum) {
    Engine engine(weightless(0.0), scenes::discs, {});
    for (int k = 0; k < 3; ++k) engine.bodies().add(scenes::disc(k, k, 0.0));
    engine.bodies().twist[0].velocity = {1.0, 0.0, 0.0};
    engine.step(0.01);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(engine.bodies().twist[k].velocity[0], 1.0 / 3.0, 1e-11);
}

// A fixed body acts as a wall: the other one stops, the fixed one does not move.
TEST(Impact, FixedBodyDoesNotMove) {
    Engine engine(weightless(0.0), scenes::discs, {});
    engine.bodies().add(scenes::disc(1, 0.0, 0.0));
    engine.bodies().add(scenes::disc(2, 1.0, 0.0));
    engine.bodies().fixed[1] = 1;
    engine.bodies().twist[0].velocity = {1.0, 0.0, 0.0};
    engine.step(0.01);
    EXPECT_NEAR(engine.bodies().twist[0].velocity[0], 0.0, 1e-14);
    EXPECT_EQ(engine.bodies().twist[1].velocity, (Vec3{}));
}

// A disc with spin 1 falls on another of the same size at rest; normal impulse p = m/2 (speed 1).
// To stop the slip friction needs R spin m_t = R/(W_tt m), with W_tt = 2/m + 2 R^2/I = 6/m: R m/6 =
// m/12 < mu p = m/4. It sticks, and the tangential speeds at the contact become equal.
TEST(Impact, FrictionStopsSlipAtTheContact) {
    Engine engine(weightless(0.5), scenes::discs, {});
    engine.bodies().add(scenes::disc(1, 0.0, 0.0));
    engine.bodies().add(scenes::disc(2, 0.0, 1.0));
    engine.bodies().twist[1] = {{0.0, -1.0, 0.0}, {0.0, 0.0, 1.0}};
    engine.step(0.01);
    const double mass = std::numbers::pi / 4;
    ASSERT_EQ(engine.impulses().size(), 1u);
    EXPECT_NEAR(engine.impulses()[0].n, mass / 2, 1e-13);
    EXPECT_NEAR(std::abs(engine.impulses()[0].t), mass / 12, 1e-13);
    const Twist low = engine.bodies().twist[0], high = engine.bodies().twist[1];
    EXPECT_NEAR(high.velocity[0] + 0.5 * high.spin[2], low.velocity[0] - 0.5 * low.spin[2], 1e-13);
}

// Across a periodic side: discs at x = 0.5 and 9.5 of a period of 10 touch and stop each other.
TEST(Impact, PairsMeetAcrossThePeriod) {
    EngineSettings settings = weightless(0.0);
    settings.box.length = {10.0, 0.0, 0.0};
    Engine engine(settings, scenes::discs, {});
    engine.bodies().add(scenes::disc(1, 0.5, 0.0));
    engine.bodies().add(scenes::disc(2, 9.5, 0.0));
    engine.bodies().twist[0].velocity = {-1.0, 0.0, 0.0};
    engine.bodies().twist[1].velocity = {1.0, 0.0, 0.0};
    engine.step(0.01);
    EXPECT_NEAR(engine.bodies().twist[0].velocity[0], 0.0, 1e-14);
    EXPECT_NEAR(engine.bodies().twist[1].velocity[0], 0.0, 1e-14);
}

// Without restitution, gravity and recovery every impulse takes energy: r . (u_before + u_after)/2
// <= 0.
TEST(Impact, GasOfDiscsNeverGainsEnergy) {
    EngineSettings settings = weightless(0.4);
    settings.law_settings.recovery_fraction = 0.0;
    settings.box.length = {12.0, 12.0, 0.0};
    Engine engine(settings, scenes::discs, {});
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (int k = 0; k < 100; ++k) {
        Body body = scenes::disc(k, 0.6 + 1.2 * (k % 10), 0.6 + 1.2 * (k / 10));
        body.twist = {{any(random), any(random), 0.0}, {0.0, 0.0, 2.0 * any(random)}};
        engine.bodies().add(body);
    }
    const auto energy = [&engine] {
        double sum = 0.0;
        const Bodies& b = engine.bodies();
        for (std::size_t i = 0; i < b.size(); ++i)
            sum += 0.5 * b.mass[i] * dot(b.twist[i].velocity, b.twist[i].velocity) +
                   0.5 * dot(b.twist[i].spin, b.inertia[i] * b.twist[i].spin);
        return sum;
    };
    const double start = energy();
    double before = start;
    for (int n = 0; n < 150; ++n) {
        engine.step(0.01);
        EXPECT_LE(energy(), before * (1 + 1e-12));
        before = energy();
        engine.move(0.01);
    }
    EXPECT_LT(before, 0.9 * start) << "they must have met";
    EXPECT_LT(engine.max_penetration(), 1e-6);
}

}  // namespace
}  // namespace turbidite::nscd
