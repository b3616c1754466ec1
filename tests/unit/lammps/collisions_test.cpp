// SPDX-License-Identifier: GPL-2.0-or-later
//
// LAMMPS' discs against known results for springs, dashpots and friction: the tests of
// tests/unit/md/md_scene_test.py, which YADE's discs pass.
#include <gtest/gtest.h>

#include "tests/unit/lammps/discs_case.hpp"

namespace turbidite::lammps {
namespace {

// A twelve-hundredth of the contact time of two equal grains, pi/w.
constexpr double fine = std::numbers::pi / frequency / 1200.0;

/// Schwager and Poeschel 2007: the contact ends when the force vanishes, before the overlap does.
double restitution(double zeta) {
    if (zeta == 1.0) return std::exp(-2.0);
    const double s = std::sqrt(1.0 - zeta * zeta);
    return std::exp(-zeta / s * std::atan2(2.0 * zeta * s, 2.0 * zeta * zeta - 1.0));
}

Settings damped(double zeta) {
    Settings settings = soft_settings();
    settings.set("run.md_damping", zeta);
    return settings;
}

// Head-on at speed 1; the largest overlap is 1/w.
TEST(Collisions, UndampedDiscsBounceInTheContactTimeAndLoseNothing) {
    Scene scene(soft_settings(), {disc(5, 3.0, 5.0, {1.0, 0.0, 0.0}), disc(9, 4.0005, 5.0)});
    int touching = 0;
    double deepest = 0.0;
    for (int i = 0; i < 400; ++i) {
        const SubstepReport report = scene.play(6, fine);
        touching += report.contacts > 0;
        deepest = std::max(deepest, report.max_penetration);
    }
    EXPECT_NEAR(touching * 6.0 * fine * frequency / std::numbers::pi, 1.0, 0.01);
    EXPECT_NEAR(deepest * frequency, 1.0, 0.005);
    EXPECT_NEAR(scene.bodies.twist[0].velocity[0], 0.0, 1e-3);
    EXPECT_NEAR(scene.bodies.twist[1].velocity[0], 1.0, 1e-3);
}

TEST(Collisions, RestitutionFollowsFromDamping) {
    for (const double zeta : {0.1, 0.3, 0.6, 0.95, 1.0}) {
        Scene scene(damped(zeta), {disc(5, 3.0, 5.0, {1.0, 0.0, 0.0}), disc(9, 4.0005, 5.0)});
        EXPECT_EQ(scene.play(6000, fine).contacts, 0);
        const double bounced =
            scene.bodies.twist[1].velocity[0] - scene.bodies.twist[0].velocity[0];
        EXPECT_NEAR(bounced, restitution(zeta), 0.004) << "zeta " << zeta;
    }
}

// k = m_r w^2: the same contact time and restitution for a small disc on a large one and on the
// floor.
TEST(Collisions, DiscsOfAnySizeAndWallsBounceAlike) {
    const double zeta = 0.3;
    Scene scene(damped(zeta),
                {disc(1, 3.0, 5.0, {1.0, 0.0, 0.0}, 0.2), disc(2, 4.2005, 5.0, {}, 1.0),
                 disc(3, 10.0, 0.3005, {0.0, -1.0, 0.0}, 0.3)});
    scene.play(6000, fine);
    EXPECT_NEAR(scene.bodies.twist[1].velocity[0] - scene.bodies.twist[0].velocity[0],
                restitution(zeta), 0.004);
    EXPECT_NEAR(scene.bodies.twist[2].velocity[1], restitution(zeta), 0.004);
}

// The lowest springs carry the weight of all: k d = n m g with k = m w^2 at the floor.
TEST(Collisions, AStackAtRestHandsItsWeightToTheFloor) {
    const int count = 5;
    Settings settings = damped(1.0);
    settings.set("run.gravity", 1.0);
    std::vector<nscd::Body> stack;
    for (int i = 0; i < count; ++i) stack.push_back(disc(i, 5.0, 0.5 + i));
    Scene scene(settings, stack);
    const SubstepReport report = scene.play(40000, 20.0 * fine);
    const double weight = stack[0].mass, window = 40000 * 20.0 * fine;
    ASSERT_EQ(report.touching.size(), std::size_t(count));
    for (const ContactRecord& contact : report.touching) {
        const double carried = double(count - (contact.wall < 0 ? contact.b : 0)) * weight;
        EXPECT_NEAR(contact.impulse[1], carried * window, 1e-3 * weight * window);  // on the upper
        EXPECT_NEAR(contact.normal[1], 1.0, 1e-9);
        EXPECT_EQ(contact.wall, contact.wall < 0 ? -1 : 2);
    }
    EXPECT_NEAR(-report.touching.back().gap, count / (frequency * frequency), 1e-6);
    EXPECT_NEAR(scene.bodies.position[0][1], 0.5 - count / (frequency * frequency), 1e-6);
    EXPECT_LT(std::abs(scene.bodies.twist[4].velocity[1]), 1e-6);
}

// A disc that slides with v and does not turn slows down by mu g until it rolls, at 2/3 v.
TEST(Collisions, ASlidingDiscSlowsDownAndRolls) {
    Settings settings = damped(1.0);
    settings.set("run.gravity", 1.0);
    const double mu = 0.3, speed = 0.3, overlap = 1.0 / (frequency * frequency);
    Scene scene(settings, {disc(1, 3.0, 0.5 - overlap, {speed, 0.0, 0.0})});
    const double half = speed / (3.0 * mu) / 2.0;  // rolls after twice that
    const SubstepReport sliding = scene.play(4000, half / 4000.0);
    ASSERT_EQ(sliding.touching.size(), 1u);
    EXPECT_EQ(sliding.touching[0].status, ContactStatus::sliding);
    EXPECT_NEAR(scene.bodies.twist[0].velocity[0], speed - mu * half, 1e-4);
    EXPECT_NEAR(scene.bodies.twist[0].spin[2], -2.0 * mu * half / 0.5, 5e-4);
    const SubstepReport rolling = scene.play(12000, half / 4000.0);
    EXPECT_EQ(rolling.touching[0].status, 0);
    EXPECT_NEAR(scene.bodies.twist[0].velocity[0], 2.0 / 3.0 * speed, 1e-3);
    EXPECT_NEAR(scene.bodies.twist[0].spin[2] * 0.5, -2.0 / 3.0 * speed, 1e-3);
}

// The moment of inertia is the caller's, and loads act.
TEST(Collisions, LoadsTurnAndPush) {
    nscd::Body body = disc(1, 5.0, 5.0);
    body.inertia = 3.0 * body.inertia;
    Scene scene(soft_settings(), {body});
    const std::vector<Load> loads = {{{0.2, -0.1, 0.0}, {0.0, 0.0, 0.07}}};
    const SubstepReport report = scene.host.run({100, 0.001, true}, loads);
    scene.host.read(scene.bodies);
    EXPECT_NEAR(scene.bodies.twist[0].velocity[0], 0.2 * 0.1 / body.mass, 1e-13);
    EXPECT_NEAR(scene.bodies.twist[0].velocity[1], -0.1 * 0.1 / body.mass, 1e-13);
    EXPECT_NEAR(scene.bodies.twist[0].spin[2], 0.07 * 0.1 / body.inertia.zz, 1e-13);
    const double angle = 0.5 * 0.07 / body.inertia.zz * 0.01;
    EXPECT_NEAR(scene.bodies.orientation[0][3], std::sin(0.5 * angle), 1e-13);
    EXPECT_NEAR(report.impulses[0][0], 0.02, 1e-15);
    EXPECT_NEAR(report.angular_impulses[0][2], 0.007, 1e-15);
}

TEST(Collisions, GrainsCanBeTakenAway) {
    Scene scene(soft_settings(), {disc(1, 3.0, 5.0), disc(2, 5.0, 5.0), disc(3, 7.0, 5.0)});
    scene.bodies.keep({1, 0, 1});
    scene.host.keep({1, 0, 1});
    scene.bodies.position = {};
    scene.bodies.position.resize(2);
    scene.play(10, 0.001);
    EXPECT_EQ(scene.bodies.position[0][0], 3.0);
    EXPECT_EQ(scene.bodies.position[1][0], 7.0);
    scene.bodies.keep({0, 0});
    scene.host.keep({0, 0});
    EXPECT_EQ(scene.play(10, 0.001).contacts, 0);
}

// A disc that lies on another and on the floor, pushed sideways: friction holds it. The state
// includes the springs; without them it would move.
TEST(Collisions, AStateHasTheSprings) {
    Settings settings = damped(1.0);
    settings.set("run.gravity", 1.0);
    const std::vector<nscd::Body> list = {disc(1, 3.0, 0.5)};
    const std::vector<Load> push = {
        {{0.1 * list[0].mass, 0.0, 0.0}, {0.0, 0.0, 0.05 * list[0].mass}}};
    Scene whole(settings, list), second(settings, list), without(settings, list);
    const auto play = [&](Scene& scene) {
        scene.host.run({2000, 5.0 * fine, false}, push);
        scene.host.read(scene.bodies);
    };
    play(whole);
    second.host.restore(whole.host.save());
    without.host.write(whole.bodies);
    for (Scene* scene : {&whole, &second, &without}) play(*scene);
    const double x = whole.bodies.position[0][0];
    EXPECT_NEAR(second.bodies.position[0][0], x, 1e-15);
    EXPECT_NEAR(second.bodies.twist[0].velocity[0], whole.bodies.twist[0].velocity[0], 1e-14);
    EXPECT_GT(std::abs(without.bodies.position[0][0] - x), 1e-7);
}

/// Two discs that are pressed against each other and pushed apart along their contact, which a
/// tangential spring holds.
struct Pressed {
    Pressed() { play(loads); }

    void play(const std::vector<Load>& acting) {
        scene.host.run({2000, 5.0 * fine, false}, acting);
        scene.host.read(scene.bodies);
    }

    static Settings settings() {
        Settings result = damped(1.0);
        result.set("run.gravity", 0.0);
        return result;
    }

    const std::vector<nscd::Body> list = {disc(2, 3.0, 5.0), disc(3, 4.0, 5.0)};
    /// Of a thousandth of a diameter of overlap, and a tenth of that along the contact.
    const double force = 5e-4 * list[0].mass * frequency * frequency;
    const std::vector<Load> loads = {{{force, 0.1 * force, 0.0}, {0.0, 0.0, 0.05 * force}},
                                     {{-force, -0.1 * force, 0.0}, {0.0, 0.0, 0.05 * force}}};
    Scene scene{settings(), list};
};

// The first window of a resumed run whose windows are repeated begins with that.
TEST(Collisions, ARestoredSceneCanBeSavedBeforeItsFirstStep) {
    Pressed first, second, third;
    second.scene.host.restore(first.scene.host.save());
    third.scene.host.restore(second.scene.host.save());
    for (Pressed* one : {&first, &third}) one->play(one->loads);
    EXPECT_NEAR(third.scene.bodies.position[1][1], first.scene.bodies.position[1][1], 1e-14);
}

}  // namespace
}  // namespace turbidite::lammps
