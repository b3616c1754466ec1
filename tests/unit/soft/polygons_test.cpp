// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Soft triangles and squares against rigid-body mechanics.
#include <gtest/gtest.h>

#include "tests/unit/soft/soft_case.hpp"

namespace turbidite::soft {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double half_height = 0.25;  ///< of the centre of a triangle over its base, R = 0.5

/// Plays one bounce: until nothing touches any more, and at most four contact times.
struct Bounce {
    explicit Bounce(Scene& scene) {
        for (int i = 0; i < 6000; ++i) {
            const SubstepReport report = scene.play(1, fine);
            if (report.contacts > 0) lasts += fine;
            points = std::max(points, report.contacts);
            deepest = std::max(deepest, report.max_penetration);
            if (lasts > 0.0 && report.contacts == 0) return;
        }
        ADD_FAILURE() << "they did not bounce";
    }
    double lasts = 0.0, deepest = 0.0;
    std::int64_t points = 0;
};

// Two points share the stiffness: flat on its side, a triangle bounces like a disc.
TEST(SoftPolygons, OnTheirSideBounceInTheContactTime) {
    for (const double zeta : {0.0, 0.3}) {
        Scene flat(damped(zeta), {grain(triangle, 1, 5.0, half_height + 5e-4, {0.0, -1.0, 0.0})});
        Scene round(damped(zeta), {grain(disc, 1, 5.0, 0.5 + 5e-4, {0.0, -1.0, 0.0})});
        const Bounce side(flat), wanted(round);
        EXPECT_EQ(side.points, 2);
        EXPECT_NEAR(side.lasts, wanted.lasts, 1.5 * fine);
        EXPECT_NEAR(side.deepest, wanted.deepest, 1e-9);
        EXPECT_NEAR(flat.velocity(0)[1], round.velocity(0)[1], 1e-9);
        EXPECT_NEAR(flat.spin(0), 0.0, 1e-9);
    }
}

// The same between two squares.
TEST(SoftPolygons, SideOnSideBounceInTheContactTime) {
    const double side = std::numbers::sqrt2 / 2.0;
    Scene scene(soft_settings(), {grain(square, 1, 5.0, 5.0, {1.0, 0.0, 0.0}),
                                  grain(square, 2, 5.0005 + side, 5.0)});
    const Bounce bounce(scene);
    EXPECT_EQ(bounce.points, 2);
    EXPECT_NEAR(bounce.lasts / contact_time, 1.0, 0.002);
    EXPECT_NEAR(bounce.deepest * frequency, 1.0, 1e-5);
    EXPECT_NEAR(scene.velocity(1)[0], 1.0, 1e-5);
}

// On its tip it has one point with half the spring: sqrt(2) contact times.
TEST(SoftPolygons, OnTheirTipTakeLonger) {
    Scene scene(soft_settings(), {grain(triangle, 1, 5.0, 0.5005, {0.0, -1.0, 0.0}, pi)});
    const Bounce bounce(scene);
    EXPECT_EQ(bounce.points, 1);
    EXPECT_NEAR(bounce.lasts / contact_time, std::numbers::sqrt2, 0.002);
    EXPECT_NEAR(bounce.deepest * frequency, std::numbers::sqrt2, 1e-4);
    EXPECT_NEAR(scene.velocity(0)[1], 1.0, 1e-4);
}

// A corner hits a floor without friction at the arm d: J = 2 v m/(1 + d^2 m/I). Nothing is lost,
// nothing happens along the floor, and the angular momentum about the corner stays what it was.
TEST(SoftPolygons, BounceOffACornerLikeRigidOnes) {
    Settings smooth = soft_settings();
    smooth.set("contact.friction", 0.0);
    smooth.set("run.md_frequency", 100.0 * frequency);  // nearly rigid: it hardly turns meanwhile
    const double angle = pi - 0.4, arm = 0.5 * std::sin(0.4), height = 0.5 * std::cos(0.4);
    for (const double along : {0.0, 0.7}) {
        Scene scene(smooth, {grain(triangle, 1, 5.0, height + 1e-5, {along, -1.0, 0.0}, angle)});
        const Vec3 corner{5.0 - (scene.bodies.orientation[0][3] > 0 ? 1.0 : -1.0) * arm, 0.0, 0.0};
        const double energy = scene.kinetic_energy(), turning = scene.angular_momentum(corner);
        scene.play(6000, fine / 100.0);
        const double mass = scene.bodies.mass[0], inertia = scene.bodies.inertia[0].zz;
        const double impulse = 2.0 * mass / (1.0 + arm * arm * mass / inertia);
        EXPECT_NEAR(scene.velocity(0)[1], -1.0 + impulse / mass, 2e-3);
        EXPECT_NEAR(std::abs(scene.spin(0)), arm * impulse / inertia, 1e-2);
        EXPECT_EQ(scene.velocity(0)[0], along);
        EXPECT_NEAR(scene.kinetic_energy() / energy, 1.0, 1e-5);
        EXPECT_NEAR(scene.angular_momentum(corner) / turning, 1.0, 5e-3);
    }
}

/// Two triangles that meet corner on side, turning.
std::vector<nscd::Body> meeting_triangles(double speed) {
    std::vector<nscd::Body> list = {grain(triangle, 1, 5.0, 5.0, {speed, 0.1, 0.0}, 0.3),
                                    grain(triangle, 2, 5.85, 5.1, {-speed, 0.0, 0.0}, 0.5, 0.6)};
    list[0].twist.spin = {0.0, 0.0, 0.8};
    return list;
}

// However they meet, action is reaction.
TEST(SoftPolygons, KeepMomentumAndAngularMomentum) {
    for (const double zeta : {0.0, 0.4}) {
        Scene scene(damped(zeta), meeting_triangles(1.0));
        const Vec3 momentum = scene.momentum();
        const double turning = scene.angular_momentum(), energy = scene.kinetic_energy();
        Bounce bounce(scene);
        EXPECT_GT(bounce.deepest, 1e-4);
        EXPECT_NEAR(scene.momentum()[0], momentum[0], 1e-13);
        EXPECT_NEAR(scene.momentum()[1], momentum[1], 1e-13);
        // Positions are half a sub-step ahead of velocities.
        EXPECT_NEAR(scene.angular_momentum(), turning, 1e-12);
        EXPECT_LT(scene.kinetic_energy(), energy * (zeta > 0.0 ? 0.95 : 1.0001));
    }
}

TEST(SoftPolygons, LoseNoEnergyWithoutDampingAndFriction) {
    Settings smooth = soft_settings();
    smooth.set("contact.friction", 0.0);
    Scene scene(smooth, meeting_triangles(1.0));
    const double energy = scene.kinetic_energy(), before = scene.velocity(0)[0];
    const Bounce bounce(scene);
    EXPECT_GT(std::abs(scene.velocity(0)[0] - before), 0.5);
    EXPECT_NEAR(scene.kinetic_energy() / energy, 1.0, 1e-4);
}

/// Share of its energy that a disc keeps, without damping, which lands obliquely on the upper side
/// of a square, `before_end` from the side's end [1/frequency], and sticks.
double share_kept(double before_end) {
    Settings rough = soft_settings();
    rough.set("contact.friction", 100.0);
    const double half_side = std::numbers::sqrt2 / 4.0;
    Scene scene(
        rough, {grain(square, 1, 5.0, 5.0), grain(disc, 2, 5.0 + half_side - before_end / frequency,
                                                  5.5 + half_side, {1.0, -1.0, 0.0})});
    const double energy = scene.kinetic_energy();
    EXPECT_EQ(Bounce(scene).points, 1);
    return scene.kinetic_energy() / energy;
}

// Passing from the side to the corner, the point keeps its tangential spring and what that has
// taken: without it 2.5 % would be lost.
TEST(SoftPolygons, KeepTheSpringOfADiscThatPassesFromASideToACorner) {
    const double on_the_side = share_kept(5.0);
    EXPECT_NEAR(on_the_side, 0.994, 1e-3);  // the rest stays in the spring as they part
    for (const double before_end : {0.1, 0.3, 0.5})
        EXPECT_NEAR(share_kept(before_end), on_the_side, 2e-3);
}

// At rest on its side: half the weight at each corner, k/2 d = m g/2.
TEST(SoftPolygons, RestOnTwoPointsThatShareTheWeight) {
    Scene scene(heavy(1.0), {grain(triangle, 1, 5.0, half_height)});
    scene.play(20000, 20.0 * fine);
    const SubstepReport report = scene.play(100, 20.0 * fine);
    const double weight = scene.bodies.mass[0] * 100 * 20.0 * fine;
    ASSERT_EQ(report.touching.size(), 2u);
    EXPECT_NE(report.touching[0].feature, report.touching[1].feature);
    for (const ContactRecord& point : report.touching) {
        EXPECT_EQ(point.wall, 2);
        EXPECT_NEAR(point.impulse[1], 0.5 * weight, 1e-9 * weight);
        EXPECT_NEAR(point.gap, -1.0 / (frequency * frequency), 1e-12);
        EXPECT_NEAR(point.length, 0.5 * 0.5 * std::sqrt(3.0), 1e-12);
    }
    EXPECT_NEAR(report.impulses[0][1], weight, 1e-9 * weight);
}

/// A triangle at rest on a slope, in axes along the slope: the weight along it is a load.
struct OnSlope {
    explicit OnSlope(double slope)
        : g_across(std::cos(slope)),
          g_along(std::sin(slope)),
          scene(heavy(1.0, g_across),
                {grain(triangle, 1, 5.0, half_height - g_across / (frequency * frequency))}) {}

    void play(double time) {
        const Vec3 along{scene.bodies.mass[0] * g_along, 0.0, 0.0};
        scene.play(std::lround(time / (10.0 * fine)), 10.0 * fine, {{along, {}}});
    }
    double g_across, g_along;
    Scene scene;
};

TEST(SoftPolygons, StandOnASlopeBelowTheAngleOfFriction) {
    OnSlope slope(std::atan(0.25));  // friction 0.3
    slope.play(0.5);
    const Vec3 place = slope.scene.bodies.position[0];
    EXPECT_LT(place[0] - 5.0, 1e-4);
    EXPECT_GT(place[0] - 5.0, 1e-7);  // the springs give way
    slope.play(2.0);
    EXPECT_NEAR(slope.scene.bodies.position[0][0], place[0], 1e-9);
    EXPECT_LT(norm(slope.scene.velocity(0)), 1e-9);
}

TEST(SoftPolygons, SlideOnASlopeAboveTheAngleOfFriction) {
    OnSlope slope(std::atan(0.5));
    const double pull = slope.g_along - 0.3 * slope.g_across;  // g (sin a - mu cos a)
    slope.play(0.2);
    const double start = slope.scene.velocity(0)[0];
    slope.play(1.0);
    EXPECT_NEAR(slope.scene.velocity(0)[0] - start, pull * 1.0, 1e-3);
    EXPECT_NEAR(slope.scene.spin(0), 0.0, 1e-3);
}

// A disc, a triangle and a square on each other: the floor carries them all.
TEST(SoftPolygons, AndDiscsStandOnEachOther) {
    const double side = std::numbers::sqrt2 / 2.0;
    Scene scene(heavy(1.0), {grain(square, 4, 5.0, 0.5 * side), grain(disc, 1, 5.0, side + 0.5),
                             grain(square, 7, 12.0, 0.5 * side),
                             grain(triangle, 3, 12.05, side + half_height)});
    scene.play(40000, 20.0 * fine);
    const SubstepReport report = scene.play(1, 20.0 * fine);
    EXPECT_EQ(report.contacts, 2 + 1 + 2 + 2);
    EXPECT_LT(scene.kinetic_energy(), 1e-12);
    double carried = 0.0, weight = 0.0;
    for (const ContactRecord& point : report.touching)
        if (point.wall == 2) carried += point.impulse[1];
    for (const double mass : scene.bodies.mass) weight += mass * 20.0 * fine;
    EXPECT_NEAR(carried, weight, 1e-8 * weight);
}

}  // namespace
}  // namespace turbidite::soft
