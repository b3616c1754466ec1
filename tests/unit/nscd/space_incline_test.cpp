// SPDX-License-Identifier: LGPL-2.1-or-later
//
// One sphere (R = 1/2, g = 1) on a plane tilted by alpha, friction mu = 0.3, from rest over t = 1.
// The plane is level and gravity is tilted. All motions are uniformly accelerated, so velocities
// are exact for any time step.
#include <gtest/gtest.h>

#include "spheres.hpp"

namespace turbidite::nscd {
namespace {

constexpr double mu = 0.3;

/// Downhill: an angle in the plane of the floor, from +x to +z.
Vec3 downhill(double heading) {
    return {std::cos(heading), 0.0, std::sin(heading)};
}

/// Velocity and spin at t = 1.
Twist after_one_second(double alpha, double heading, double dt) {
    EngineSettings settings = scenes::exact_in_space(mu, 1e-13);
    settings.gravity = std::sin(alpha) * downhill(heading) + Vec3{0.0, -std::cos(alpha), 0.0};
    Engine engine(settings, scenes::spheres, {scenes::floor(mu)});
    engine.bodies().add(scenes::sphere(1, {0.0, 0.5, 0.0}));
    EXPECT_TRUE(scenes::run(engine, 1.0, dt));
    EXPECT_NEAR(engine.bodies().position[0][1], 0.5, 1e-12);
    return engine.bodies().twist[0];
}

/// Rolling down turns about n x downhill.
void expect_motion(const Twist& end, double heading, double speed, double spin) {
    const Vec3 along = downhill(heading), about = cross({0.0, 1.0, 0.0}, along);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(end.velocity[i], speed * along[i], 1e-9) << heading;
        EXPECT_NEAR(end.spin[i], spin * about[i], 1e-9) << heading;
    }
}

const double headings[] = {0.0, 0.3, 1.1, std::numbers::pi / 2, 2.5, -2.0};

// Rolling: m a = m g sin a - F, I a/R = F R, I = 2/5 m R^2: a = 5/7 g sin a, F = 2/7 m g sin a,
// which friction provides iff tan a <= 3.5 mu.
TEST(SpaceIncline, ASphereRollsUpToThreeAndAHalfTimesTheFriction) {
    for (const double dt : {0.02, 0.005})
        for (const double share : {0.5, 0.999})
            for (const double heading : headings) {
                const double alpha = std::atan(3.5 * share * mu);
                const double speed = 5.0 / 7.0 * std::sin(alpha);
                expect_motion(after_one_second(alpha, heading, dt), heading, speed, speed / 0.5);
            }
}

// Beyond: F = mu m g cos a; a = g (sin a - mu cos a), spin rate = F R/I = 5/2 mu g cos a/R.
TEST(SpaceIncline, ASphereSlidesBeyondIt) {
    for (const double dt : {0.02, 0.005})
        for (const double share : {1.001, 2.0})
            for (const double heading : headings) {
                const double alpha = std::atan(3.5 * share * mu);
                expect_motion(after_one_second(alpha, heading, dt), heading,
                              std::sin(alpha) - mu * std::cos(alpha),
                              2.5 * mu * std::cos(alpha) / 0.5);
            }
}

// A sphere that slides and spins about any axis: the whole motion turned about the vertical is the
// motion from the turned start, until it rolls and beyond.
TEST(SpaceIncline, SlidingIsIndependentOfTheDirection) {
    const auto run = [](double heading) {
        Engine engine(scenes::exact_in_space(mu, 1e-13), scenes::spheres, {scenes::floor(mu)});
        engine.bodies().add(scenes::sphere(1, {0.0, 0.5, 0.0}));
        const Vec3 along = downhill(heading), across = cross({0.0, 1.0, 0.0}, along);
        engine.bodies().twist[0] = {1.5 * along + 0.4 * across,
                                    2.0 * along - 3.0 * across + Vec3{0.0, 1.0, 0.0}};
        EXPECT_TRUE(scenes::run(engine, 2.0, 0.01));
        const Vec3 v = engine.bodies().twist[0].velocity, w = engine.bodies().twist[0].spin;
        const Vec3 x = engine.bodies().position[0];
        return std::vector{dot(v, along), dot(v, across), dot(w, along), dot(w, across),
                           w[1],          dot(x, along),  dot(x, across)};
    };
    const std::vector<double> straight = run(0.0);
    EXPECT_GT(straight[0], 0.3) << "it moves";
    EXPECT_LT(straight[0], 1.4) << "friction acts";
    EXPECT_GT(std::abs(straight[6]), 0.3) << "on a curve";
    EXPECT_NEAR(straight[4], 1.0, 1e-12) << "no torsion: the spin about the normal stays";
    for (const double heading : headings) {
        const std::vector<double> turned = run(heading);
        for (std::size_t i = 0; i < turned.size(); ++i)
            EXPECT_NEAR(turned[i], straight[i], 1e-9) << heading << " " << i;
    }
}

// The same on a plane of any orientation, with gravity along its normal; some normals are near e_z,
// where frames made from the normal are singular.
TEST(SpaceIncline, SlidingIsIndependentOfTheNormal) {
    const auto speed = [](const Vec3& n) {
        EngineSettings settings = scenes::exact_in_space(mu, 1e-13);
        settings.gravity = -n;
        Engine engine(settings, scenes::spheres, {scenes::wall(1, {}, n, mu)});
        engine.bodies().add(scenes::sphere(1, 0.5 * n));
        const Vec3 along = tangent_of(n);
        engine.bodies().twist[0].velocity = 2.0 * along;
        EXPECT_TRUE(scenes::run(engine, 1.0, 0.01));
        EXPECT_NEAR(dot(engine.bodies().position[0], n), 0.5, 1e-12);
        return dot(engine.bodies().twist[0].velocity, along);
    };
    for (const Vec3& n : {Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{0.6, 0, -0.8}, Vec3{1e-9, 0, 1.0},
                          Vec3{0.36, 0.48, 0.8}})
        EXPECT_NEAR(speed(n), 2.0 - mu, 1e-9) << n[0] << " " << n[1] << " " << n[2];
}

}  // namespace
}  // namespace turbidite::nscd
