// SPDX-License-Identifier: GPL-2.0-or-later
//
// Grains in LAMMPS that meet and travel across cyclic sides.
#include <gtest/gtest.h>

#include "tests/unit/lammps/discs_case.hpp"

namespace turbidite::lammps {
namespace {

constexpr double fine = std::numbers::pi / frequency / 1200.0;

/// Head-on from both sides of the seam along an axis, `period` long; a is below it, b above.
void expect_bounce(Scene& scene, int axis, double period) {
    bool met = false;
    for (int i = 0; i < 400; ++i) {
        const SubstepReport report = scene.play(6, fine);
        for (const ContactRecord& contact : report.touching) {
            met = true;
            EXPECT_EQ(contact.a, 5u);
            EXPECT_EQ(contact.b, 9u);
            EXPECT_NEAR(contact.normal[axis], 1.0, 1e-12);  // from a across the seam to b
            EXPECT_NEAR(contact.branch[axis], 1.0 + contact.gap, 1e-12);
            // Beside b, which is in the box: its place less its arm.
            const std::size_t b = scene.bodies.id[0] == 9 ? 0 : 1;
            EXPECT_NEAR(contact.point[axis],
                        scene.bodies.position[b][axis] - 0.5 * contact.branch[axis], 1e-12);
        }
        for (const Vec3& place : scene.bodies.position) {
            EXPECT_GE(place[axis], 0.0);
            EXPECT_LT(place[axis], period);
        }
    }
    EXPECT_TRUE(met);
    EXPECT_NEAR(scene.bodies.twist[0].velocity[axis], 0.0, 1e-3);
    EXPECT_NEAR(scene.bodies.twist[1].velocity[axis], 1.0, 1e-3);
}

TEST(Cyclic, DiscsBounceAcrossTheSides) {
    Scene scene(cyclic(soft_settings(), "domain.left", "domain.right"),
                {disc(5, 19.3, 5.0, {1.0, 0.0, 0.0}), disc(9, 0.3005, 5.0)});
    expect_bounce(scene, 0, 20.0);
}

TEST(Cyclic, DiscsBounceAcrossFloorAndTop) {
    Scene scene(cyclic(soft_settings(), "domain.bottom", "domain.top"),
                {disc(5, 5.0, 9.3, {0.0, 1.0, 0.0}), disc(9, 5.0, 0.3005)});
    expect_bounce(scene, 1, 10.0);
}

TEST(Cyclic, SpheresBounceAcrossFrontAndBack) {
    Scene scene(
        cyclic(soft_settings_in_space(0.0, 0.0), "domain.front", "domain.back"),
        {soft_sphere(5, {5, 5, 11.3}, {0, 0, 1}), soft_sphere(9, {5, 5, 0.3005}, {0, 0, 0})},
        MPI_COMM_SELF, "sphere");
    expect_bounce(scene, 2, 12.0);
}

TEST(Cyclic, WhatLeavesOnOneSideComesInOnTheOther) {
    Scene scene(cyclic(soft_settings(), "domain.left", "domain.right"),
                {disc(5, 19.9, 5.0, {1.0, 0.0, 0.0}), disc(9, 0.05, 7.0, {-0.5, 0.0, 0.0})});
    scene.play(200, 0.001);
    EXPECT_NEAR(scene.bodies.position[0][0], 0.1, 1e-12);
    EXPECT_NEAR(scene.bodies.position[1][0], 19.95, 1e-12);
    scene.host.write(scene.bodies);
    scene.play(200, 0.001);
    EXPECT_NEAR(scene.bodies.position[0][0], 0.3, 1e-12);
    EXPECT_NEAR(scene.bodies.position[1][0], 19.85, 1e-12);
}

// LAMMPS sorts grains anew when one has moved by half the skin, 0.05, and leaves them where they
// are until then.
TEST(Cyclic, OneThatIsBarelyBeyondTheSideIsInTheBox) {
    Settings settings = soft_settings();
    settings.set("run.gravity", 1.0), settings.set("run.md_damping", 1.0);
    const double overlap = 1.0 / (frequency * frequency);
    Scene scene(cyclic(settings, "domain.left", "domain.right"),
                {disc(1, 19.99, 0.5 - overlap, {0.2, 0.0, 0.0})});
    scene.bodies.twist[0].spin = {0.0, 0.0, -0.4};
    scene.host.write(scene.bodies);
    const SubstepReport report = scene.play(400, 0.25e-3);
    EXPECT_NEAR(scene.bodies.position[0][0], 0.01, 1e-5);
    ASSERT_EQ(report.touching.size(), 1u);
    EXPECT_NEAR(report.touching[0].point[0], scene.bodies.position[0][0], 1e-12);
}

// A disc that rolls on the floor over the seam: its spring does not notice.
TEST(Cyclic, SpringsAtWallsSurviveTheSeam) {
    Settings settings = soft_settings();
    settings.set("run.gravity", 1.0), settings.set("run.md_damping", 1.0);
    const double overlap = 1.0 / (frequency * frequency), speed = 0.3;
    nscd::Body rolling = disc(1, 19.9, 0.5 - overlap, {speed, 0.0, 0.0});
    rolling.twist.spin = {0.0, 0.0, -2.0 * speed};
    Scene scene(cyclic(settings, "domain.left", "domain.right"), {rolling});
    const SubstepReport report = scene.play(4000, 0.25e-3);
    EXPECT_NEAR(scene.bodies.position[0][0], 0.2, 1e-6);
    EXPECT_NEAR(scene.bodies.twist[0].velocity[0], speed, 1e-6);
    ASSERT_EQ(report.touching.size(), 1u);
    EXPECT_EQ(report.touching[0].wall, 2);
    EXPECT_NEAR(report.touching[0].point[0], scene.bodies.position[0][0], 1e-12);
}

}  // namespace
}  // namespace turbidite::lammps
