// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Soft discs against known results for springs, dashpots and friction: the tests of
// tests/unit/md/md_scene_test.py and tests/unit/lammps/collisions_test.cpp, which the discs of YADE
// and of LAMMPS pass.
#include <gtest/gtest.h>

#include "tests/unit/soft/soft_case.hpp"

namespace turbidite::soft {
namespace {

/// Schwager and Poeschel 2007: the contact ends when the force vanishes, before the overlap does.
double restitution(double zeta) {
    if (zeta == 1.0) return std::exp(-2.0);
    const double s = std::sqrt(1.0 - zeta * zeta);
    return std::exp(-zeta / s * std::atan2(2.0 * zeta * s, 2.0 * zeta * zeta - 1.0));
}

// Head-on at speed 1; the largest overlap is 1/w.
TEST(SoftDiscs, BounceUndampedInTheContactTimeAndLoseNothing) {
    Scene scene(soft_settings(),
                {grain(disc, 5, 3.0, 5.0, {1.0, 0.0, 0.0}), grain(disc, 9, 4.0005, 5.0)});
    int touching = 0;
    double deepest = 0.0;
    for (int i = 0; i < 2400; ++i) {
        const SubstepReport report = scene.play(1, fine);
        touching += report.contacts > 0;
        deepest = std::max(deepest, report.max_penetration);
    }
    EXPECT_NEAR(touching * fine / contact_time, 1.0, 0.002);
    EXPECT_NEAR(deepest * frequency, 1.0, 1e-5);
    EXPECT_NEAR(scene.velocity(0)[0], 0.0, 1e-5);
    EXPECT_NEAR(scene.velocity(1)[0], 1.0, 1e-5);
}

TEST(SoftDiscs, HaveTheRestitutionOfTheirDamping) {
    for (const double zeta : {0.1, 0.3, 0.6, 0.95, 1.0}) {
        Scene scene(damped(zeta),
                    {grain(disc, 5, 3.0, 5.0, {1.0, 0.0, 0.0}), grain(disc, 9, 4.0005, 5.0)});
        EXPECT_EQ(scene.play(6000, fine).contacts, 0);
        EXPECT_NEAR(scene.velocity(1)[0] - scene.velocity(0)[0], restitution(zeta), 0.004)
            << "zeta " << zeta;
    }
}

// k = m_r w^2: the same contact time and restitution for a small disc on a large one and on the
// floor.
TEST(SoftDiscs, OfAnySizeAndAtWallsBounceAlike) {
    const double zeta = 0.3;
    Scene scene(damped(zeta), {grain(disc, 1, 3.0, 5.0, {1.0, 0.0, 0.0}, 0.0, 0.2),
                               grain(disc, 2, 4.2005, 5.0, {}, 0.0, 1.0),
                               grain(disc, 3, 10.0, 0.3005, {0.0, -1.0, 0.0}, 0.0, 0.3)});
    scene.play(6000, fine);
    EXPECT_NEAR(scene.velocity(1)[0] - scene.velocity(0)[0], restitution(zeta), 0.004);
    EXPECT_NEAR(scene.velocity(2)[1], restitution(zeta), 0.004);
}

// At a large angle the contact slides throughout: the tangential impulse is mu times the normal
// one, which is m v without damping, and turns the disc by J_t R/I = 2 J_t/(m R).
TEST(SoftDiscs, ThatSlideOnImpactLoseFrictionTimesTheNormalImpulse) {
    const double mu = 0.3;
    Scene scene(soft_settings(), {grain(disc, 1, 3.0, 0.5005, {3.0, -1.0, 0.0})});
    scene.play(4000, fine);
    EXPECT_NEAR(scene.velocity(0)[1], 1.0, 1e-3);
    EXPECT_NEAR(scene.velocity(0)[0], 3.0 - 2.0 * mu, 2e-3);
    EXPECT_NEAR(scene.spin(0), -2.0 * mu * 2.0 / 0.5, 8e-3);
}

// At a small angle it sticks. k_t = k/3 with m/3 at the point along the floor: as long as the
// bounce lasts both directions oscillate with the same period, so that the velocity of the point is
// reversed, v_t' = -v_t. With J_t = -2 v_t m/3.
TEST(SoftDiscs, ThatStickOnImpactComeBackAlongTheContactAsAcrossIt) {
    const double along = 0.05;
    Scene scene(soft_settings(), {grain(disc, 1, 3.0, 0.5005, {along, -1.0, 0.0})});
    scene.play(4000, fine);
    EXPECT_NEAR(scene.velocity(0)[1], 1.0, 1e-3);
    EXPECT_NEAR(scene.velocity(0)[0], along / 3.0, 2e-3 * along);
    EXPECT_NEAR(scene.spin(0), -2.0 * (2.0 / 3.0) * along / 0.5, 1e-2 * along);
    EXPECT_NEAR(scene.velocity(0)[0] + 0.5 * scene.spin(0), -along, 1e-2 * along);
}

// The lowest springs carry the weight of all: k d = n m g with k = m w^2 at the floor.
TEST(SoftDiscs, InAStackAtRestHandTheirWeightToTheFloor) {
    const int count = 5;
    std::vector<nscd::Body> stack;
    for (int i = 0; i < count; ++i) stack.push_back(grain(disc, i, 5.0, 0.5 + i));
    Scene scene(heavy(1.0), stack);
    const double step = 20.0 * fine;
    scene.play(40000, step);
    const SubstepReport report = scene.play(100, step);
    const double weight = stack[0].mass, window = 100 * step;
    ASSERT_EQ(report.touching.size(), std::size_t(count));
    for (const ContactRecord& contact : report.touching) {
        const double carried = double(count - (contact.wall < 0 ? contact.b : 0)) * weight;
        EXPECT_NEAR(contact.impulse[1], carried * window, 1e-6 * weight * window);  // on the upper
        EXPECT_NEAR(contact.normal[1], 1.0, 1e-9);
        EXPECT_EQ(contact.wall, contact.wall < 0 ? -1 : 2);
    }
    EXPECT_NEAR(-report.touching.back().gap, count / (frequency * frequency), 1e-9);
    EXPECT_NEAR(scene.bodies.position[0][1], 0.5 - count / (frequency * frequency), 1e-9);
}

// A disc that slides with v and does not turn slows down by mu g until it rolls, at 2/3 v.
TEST(SoftDiscs, ThatSlideSlowDownUntilTheyRoll) {
    const double mu = 0.3, speed = 0.3, overlap = 1.0 / (frequency * frequency);
    Scene scene(heavy(1.0), {grain(disc, 1, 3.0, 0.5 - overlap, {speed, 0.0, 0.0})});
    const double half = speed / (3.0 * mu) / 2.0;  // rolls after twice that
    const SubstepReport sliding = scene.play(4000, half / 4000.0);
    ASSERT_EQ(sliding.touching.size(), 1u);
    EXPECT_EQ(sliding.touching[0].status, ContactStatus::sliding);
    EXPECT_NEAR(scene.velocity(0)[0], speed - mu * half, 1e-4);
    EXPECT_NEAR(scene.spin(0), -2.0 * mu * half / 0.5, 5e-4);
    const SubstepReport rolling = scene.play(12000, half / 4000.0);
    EXPECT_EQ(rolling.touching[0].status, 0);
    EXPECT_NEAR(scene.velocity(0)[0], 2.0 / 3.0 * speed, 1e-3);
    EXPECT_NEAR(scene.spin(0) * 0.5, -2.0 / 3.0 * speed, 1e-3);
}

TEST(SoftDiscs, AreTurnedAndPushedByLoads) {
    nscd::Body body = grain(disc, 1, 5.0, 5.0);
    body.inertia = 3.0 * body.inertia;
    Scene scene(soft_settings(), {body});
    const SubstepReport report = scene.play(100, 0.001, {{{0.2, -0.1, 0.0}, {0.0, 0.0, 0.07}}});
    EXPECT_NEAR(scene.velocity(0)[0], 0.2 * 0.1 / body.mass, 1e-13);
    EXPECT_NEAR(scene.velocity(0)[1], -0.1 * 0.1 / body.mass, 1e-13);
    EXPECT_NEAR(scene.spin(0), 0.07 * 0.1 / body.inertia.zz, 1e-13);
    EXPECT_NEAR(report.impulses[0][0], 0.02, 1e-15);
    EXPECT_NEAR(report.angular_impulses[0][2], 0.007, 1e-15);
}

}  // namespace
}  // namespace turbidite::soft
