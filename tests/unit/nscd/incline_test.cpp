// SPDX-License-Identifier: LGPL-2.1-or-later
//
// One disc (R = 1/2, g = 1) on a plane tilted by alpha, friction mu = 0.3, from rest over t = 1.
// Here the plane is level and gravity is tilted, with downhill = +x. All motions are uniformly
// accelerated, so velocities are exact for any time step.
#include <gtest/gtest.h>

#include "scenes.hpp"

namespace turbidite::nscd {
namespace {

constexpr double mu = 0.3;

/// Velocity and spin at t = 1.
Twist after_one_second(double alpha, bool rotation_blocked, double dt) {
    EngineSettings settings = scenes::exact(mu, 1e-13);
    settings.gravity = scenes::tilted(alpha);
    Engine engine(settings, scenes::discs, {scenes::floor(mu)});
    engine.bodies().add(scenes::disc(1, 0.0, 0.5));
    engine.bodies().rotation_blocked[0] = rotation_blocked;
    EXPECT_TRUE(scenes::run(engine, 1.0, dt));
    EXPECT_NEAR(engine.bodies().position[0][1], 0.5, 1e-12);
    return engine.bodies().twist[0];
}

const double steps[] = {0.02, 0.01, 0.005};

TEST(Incline, BlockedDiscSticksUpToTheFrictionAngle) {
    for (const double dt : steps)
        for (const double share : {0.5, 0.999}) {
            const Twist end = after_one_second(std::atan(share * mu), true, dt);
            EXPECT_NEAR(end.velocity[0], 0.0, 1e-12);
        }
}

// a = g (sin a - mu cos a)
TEST(Incline, BlockedDiscSlidesBeyondIt) {
    for (const double dt : steps)
        for (const double share : {1.001, 2.0}) {
            const double alpha = std::atan(share * mu);
            const Twist end = after_one_second(alpha, true, dt);
            EXPECT_NEAR(end.velocity[0], std::sin(alpha) - mu * std::cos(alpha), 1e-12);
        }
}

// Rolling: m a = m g sin a - F, I a / R = F R, I = m R^2 / 2: a = 2/3 g sin a, F = m g sin a / 3,
// which friction provides iff tan a <= 3 mu. Downhill rolling turns clockwise: spin = -a t / R.
TEST(Incline, FreeDiscRollsUpToThreeTimesTheFriction) {
    for (const double dt : steps)
        for (const double share : {0.5, 0.999}) {
            const double alpha = std::atan(3.0 * share * mu);
            const Twist end = after_one_second(alpha, false, dt);
            EXPECT_NEAR(end.velocity[0], 2.0 / 3.0 * std::sin(alpha), 1e-12);
            EXPECT_NEAR(end.spin[2], -2.0 * end.velocity[0], 1e-11);
        }
}

// Beyond: F = mu m g cos a; a = g (sin a - mu cos a), spin rate = -F R / I = -2 mu g cos a / R.
TEST(Incline, FreeDiscSlidesBeyondIt) {
    for (const double dt : steps)
        for (const double share : {1.001, 2.0}) {
            const double alpha = std::atan(3.0 * share * mu);
            const Twist end = after_one_second(alpha, false, dt);
            EXPECT_NEAR(end.velocity[0], std::sin(alpha) - mu * std::cos(alpha), 1e-12);
            EXPECT_NEAR(end.spin[2], -4.0 * mu * std::cos(alpha), 1e-11);
        }
}

}  // namespace
}  // namespace turbidite::nscd
