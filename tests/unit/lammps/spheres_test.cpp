// SPDX-License-Identifier: GPL-2.0-or-later
//
// LAMMPS' spheres against known results for springs, dashpots and friction: the tests of
// tests/unit/soft/spheres_test.cpp.
#include <gtest/gtest.h>

#include "tests/unit/lammps/discs_case.hpp"

namespace turbidite::lammps {
namespace {

constexpr double fine = std::numbers::pi / frequency / 1200.0;
constexpr double radius = 0.5;

struct SpaceScene : Scene {
    SpaceScene(const Settings& settings, const std::vector<nscd::Body>& spheres)
        : Scene(settings, spheres, MPI_COMM_SELF, "sphere") {}
};

Vec3 direction(double angle) {
    return {std::cos(angle), 0.0, std::sin(angle)};
}

// v_t' = -v_t at the point; the centre keeps 3/7 of its velocity along the floor.
TEST(Spheres, ThatStickOnImpactComeBackAlongTheContactAsAcrossIt) {
    const double along = 0.05;
    for (const double angle : {0.0, 0.7, 2.5}) {
        const Vec3 d = direction(angle);
        SpaceScene scene(soft_settings_in_space(0.0, 0.0),
                         {soft_sphere(1, {5.0, 0.5005, 6.0}, along * d + Vec3{0.0, -1.0, 0.0})});
        scene.play(4000, fine);
        const Twist& twist = scene.bodies.twist[0];
        EXPECT_NEAR(twist.velocity[1], 1.0, 2e-3);
        EXPECT_NEAR(dot(twist.velocity, d), 3.0 / 7.0 * along, 1e-2 * along);
        EXPECT_NEAR(dot(twist.at({0.0, -radius, 0.0}), d), -along, 2e-2 * along);
    }
}

// Slows down by mu g until it rolls, at 5/7 v, and turns about the horizontal across its way.
TEST(Spheres, ThatSlideSlowDownUntilTheyRoll) {
    const double mu = 0.3, speed = 0.3, overlap = 1.0 / (frequency * frequency);
    for (const double angle : {0.0, 1.9}) {
        const Vec3 d = direction(angle);
        SpaceScene scene(soft_settings_in_space(1.0, 1.0),
                         {soft_sphere(1, {5.0, radius - overlap, 6.0}, speed * d)});
        const double half = 2.0 * speed / (7.0 * mu) / 2.0;  // rolls after twice that
        const SubstepReport sliding = scene.play(4000, half / 4000.0);
        ASSERT_EQ(sliding.touching.size(), 1u);
        EXPECT_EQ(sliding.touching[0].status, ContactStatus::sliding);
        EXPECT_NEAR(dot(scene.bodies.twist[0].velocity, d), speed - mu * half, 1e-4);
        scene.play(12000, half / 4000.0);
        EXPECT_NEAR(dot(scene.bodies.twist[0].velocity, d), 5.0 / 7.0 * speed, 1e-3);
        const Vec3 axis = cross(Vec3{0.0, 1.0, 0.0}, d);
        EXPECT_NEAR(dot(scene.bodies.twist[0].spin, axis), 5.0 / 7.0 * speed / radius, 2e-3);
        const Quaternion& q = scene.bodies.orientation[0];
        EXPECT_GT(norm(Vec3{q[1], q[2], q[3]}), 0.01);
        EXPECT_NEAR(norm(cross(Vec3{q[1], q[2], q[3]}, axis)), 0.0, 1e-6);
    }
}

TEST(Spheres, HaveAFrontAndABackAndAreTold) {
    SpaceScene scene(soft_settings_in_space(0.0, 0.0),
                     {soft_sphere(1, {3.0, 5.0, 0.5005}, {0.0, 0.0, -1.0}),
                      soft_sphere(2, {6.0, 5.0, 11.4995}, {0.0, 0.0, 1.0})});
    const SubstepReport during = scene.play(900, fine);
    ASSERT_EQ(during.touching.size(), 2u);
    EXPECT_EQ(during.touching[0].wall, 4);
    EXPECT_EQ(during.touching[1].wall, 5);
    scene.play(3100, fine);
    EXPECT_NEAR(scene.bodies.twist[0].velocity[2], 1.0, 2e-3);
    EXPECT_NEAR(scene.bodies.twist[1].velocity[2], -1.0, 2e-3);
}

TEST(Spheres, AreTurnedAndPushedByLoadsInSpace) {
    SpaceScene scene(soft_settings_in_space(0.0, 0.0), {soft_sphere(1, {5.0, 5.0, 5.0}, {})});
    const nscd::Body body = soft_sphere(1, {}, {});
    const SubstepReport report =
        scene.host.run({100, 0.001, true}, {{{0.2, -0.1, 0.4}, {0.01, 0.02, 0.07}}});
    scene.host.read(scene.bodies);
    const Vec3 gained = (0.1 / body.mass) * Vec3{0.2, -0.1, 0.4};
    const Vec3 turned = (0.1 / body.inertia.zz) * Vec3{0.01, 0.02, 0.07};
    EXPECT_NEAR(norm(scene.bodies.twist[0].velocity - gained), 0.0, 1e-13);
    EXPECT_NEAR(norm(scene.bodies.twist[0].spin - turned), 0.0, 1e-12);
    EXPECT_NEAR(norm(report.impulses[0] - Vec3{0.02, -0.01, 0.04}), 0.0, 1e-15);
    EXPECT_NEAR(norm(report.angular_impulses[0] - Vec3{0.001, 0.002, 0.007}), 0.0, 1e-15);
}

}  // namespace
}  // namespace turbidite::lammps
