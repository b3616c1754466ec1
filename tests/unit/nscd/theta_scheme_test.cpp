// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/engine/theta_scheme.hpp"

#include <gtest/gtest.h>

#include "coupler/rigid/vec3.hpp"
#include "scenes.hpp"

namespace turbidite::nscd {
namespace {

// From rest, g = 1, t = n dt: U = -t exactly. Eq. 17 gives x_n = -dt^2 sum_{k<n} (theta (k+1) +
// (1-theta) k) = -t^2/2 - (theta - 1/2) t dt, and q = x + (1-theta) dt U = -t^2/2 - t dt/2 for any
// theta.
TEST(ThetaScheme, FreeFallIsExactUpToTheKnownOffset) {
    for (const double theta : {0.5, 0.75, 1.0})
        for (const double dt : {0.02, 0.01, 0.005}) {
            EngineSettings settings = scenes::exact(0.0);
            settings.theta = theta;
            Engine engine(settings, scenes::discs, {});
            engine.bodies().add(scenes::disc(1, 0.0, 0.0));
            scenes::run(engine, 1.0, dt);
            const Vec3 velocity = engine.bodies().twist[0].velocity;
            const Vec3 q = engine.bodies().position[0];
            EXPECT_NEAR(velocity[1], -1.0, 1e-12);
            EXPECT_NEAR(q[1], -0.5 - 0.5 * dt, 1e-12);
            EXPECT_NEAR(end_configuration(q, velocity, dt, theta)[1], -0.5 - (theta - 0.5) * dt,
                        1e-12);
        }
}

// F = 3, torque 2 over dt = 0.1 on m = pi/4, I = m/8.
TEST(ThetaScheme, TakesLoadsOfTheHost) {
    Bodies bodies;
    bodies.add(scenes::disc(1, 0.0, 0.0));
    bodies.force[0] = {3.0, 0.0, 0.0};
    bodies.torque[0] = {0.0, 0.0, 2.0};
    const auto free = free_velocities(bodies, {0.0, -1.0, 0.0}, 0.1);
    const double mass = std::numbers::pi / 4;
    EXPECT_NEAR(free[0].velocity[0], 0.3 / mass, 1e-15);
    EXPECT_NEAR(free[0].velocity[1], -0.1, 1e-15);
    EXPECT_NEAR(free[0].spin[2], 0.2 / (mass / 8), 1e-14);
}

// A fixed body ignores all loads; one with blocked rotation ignores torques.
TEST(ThetaScheme, RespectsFlags) {
    Bodies bodies;
    bodies.add(scenes::disc(1, 0.0, 0.0));
    bodies.add(scenes::disc(2, 5.0, 0.0));
    bodies.fixed[0] = 1;
    bodies.rotation_blocked[1] = 1;
    bodies.torque = {{0, 0, 1}, {0, 0, 1}};
    const auto free = free_velocities(bodies, {0.0, -1.0, 0.0}, 0.1);
    EXPECT_EQ(free[0].velocity, (Vec3{}));
    EXPECT_NEAR(free[1].velocity[1], -0.1, 1e-15);
    EXPECT_EQ(free[1].spin, (Vec3{}));
}

// Spin pi/2 per unit time for 1 in 100 steps: a quarter revolution, (cos 45, 0, 0, sin 45).
TEST(ThetaScheme, TurnsTheOrientation) {
    Bodies bodies;
    bodies.add(scenes::disc(1, 0.0, 0.0));
    bodies.twist[0].spin = {0.0, 0.0, std::numbers::pi / 2};
    for (int n = 0; n < 100; ++n) move(bodies, bodies.twist, 0.01, {});
    EXPECT_NEAR(bodies.orientation[0][0], std::sqrt(0.5), 1e-13);
    EXPECT_NEAR(bodies.orientation[0][3], std::sqrt(0.5), 1e-13);
}

// A quarter revolution about x, then about y: e_z goes to -e_y, which y leaves unchanged.
TEST(ThetaScheme, ComposesTurnsInWorldAxes) {
    const double quarter = std::numbers::pi / 2;
    const Quaternion q = rotated(rotated({1, 0, 0, 0}, {quarter, 0, 0}), {0, quarter, 0});
    const Vec3 axis{q[1], q[2], q[3]}, z{0, 0, 1};
    const Vec3 twice = 2.0 * cross(axis, z);
    const Vec3 turned = z + q[0] * twice + cross(axis, twice);
    EXPECT_NEAR(turned[0], 0.0, 1e-15);
    EXPECT_NEAR(turned[1], -1.0, 1e-15);
    EXPECT_NEAR(turned[2], 0.0, 1e-15);
}

TEST(ThetaScheme, WrapsPeriodicPositions) {
    Bodies bodies;
    bodies.add(scenes::disc(1, 9.5, 0.0));
    bodies.twist[0].velocity = {1.0, 1.0, 0.0};
    PeriodicBox box;
    box.length = {10.0, 0.0, 0.0};
    move(bodies, bodies.twist, 1.0, box);
    EXPECT_NEAR(bodies.position[0][0], 0.5, 1e-14);
    EXPECT_NEAR(bodies.position[0][1], 1.0, 1e-14);
}

}  // namespace
}  // namespace turbidite::nscd
