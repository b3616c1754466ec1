// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Soft spheres against known results for springs, dashpots and friction, in several directions.
#include <gtest/gtest.h>

#include "tests/unit/soft/soft_case.hpp"

namespace turbidite::soft {
namespace {

constexpr double radius = 0.5;

struct SpaceScene : Scene {
    SpaceScene(const Settings& settings, const std::vector<nscd::Body>& spheres)
        : Scene(settings, spheres, {{"sphere", {}}}) {}
};

/// Horizontal, at an angle to x.
Vec3 direction(double angle) {
    return {std::cos(angle), 0.0, std::sin(angle)};
}

// At a small angle the contact sticks. k_t = 2/7 k with 2/7 m at the point along the floor: both
// directions take the same time, so that v_t' = -v_t at the point. With J_t = -2 v_t (2/7) m the
// centre keeps 3/7 of its velocity along the floor.
TEST(SoftSpheres, ThatStickOnImpactComeBackAlongTheContactAsAcrossIt) {
    const double along = 0.05;
    for (const double angle : {0.0, 0.7, 2.5}) {
        const Vec3 d = direction(angle);
        SpaceScene scene(soft_settings_in_space(0.0, 0.0),
                         {soft_sphere(1, {5.0, 0.5005, 6.0}, along * d + Vec3{0.0, -1.0, 0.0})});
        scene.play(4000, fine);
        const Twist& twist = scene.bodies.twist[0];
        EXPECT_NEAR(twist.velocity[1], 1.0, 1e-3);
        EXPECT_NEAR(
            norm(twist.velocity - Vec3{0.0, twist.velocity[1], 0.0} - (3.0 / 7.0 * along) * d), 0.0,
            2e-3 * along);
        const Vec3 at_point = twist.at({0.0, -radius, 0.0});
        EXPECT_NEAR(dot(at_point, d), -along, 1e-2 * along);
    }
}

// A sphere that slides with v and does not turn slows down by mu g until it rolls, at 5/7 v; the
// way does not depend on the direction.
TEST(SoftSpheres, ThatSlideSlowDownUntilTheyRoll) {
    const double mu = 0.3, speed = 0.3, overlap = 1.0 / (frequency * frequency);
    double way = 0.0;
    for (const double angle : {0.0, 0.4, 1.9}) {
        const Vec3 d = direction(angle);
        SpaceScene scene(soft_settings_in_space(1.0, 1.0),
                         {soft_sphere(1, {5.0, radius - overlap, 6.0}, speed * d)});
        const double half = 2.0 * speed / (7.0 * mu) / 2.0;  // rolls after twice that
        const SubstepReport sliding = scene.play(4000, half / 4000.0);
        ASSERT_EQ(sliding.touching.size(), 1u);
        EXPECT_EQ(sliding.touching[0].status, ContactStatus::sliding);
        EXPECT_NEAR(dot(scene.bodies.twist[0].velocity, d), speed - mu * half, 1e-4);
        const SubstepReport rolling = scene.play(12000, half / 4000.0);
        EXPECT_EQ(rolling.touching[0].status, 0);
        EXPECT_NEAR(dot(scene.bodies.twist[0].velocity, d), 5.0 / 7.0 * speed, 1e-3);
        const double gone = norm(scene.bodies.position[0] - Vec3{5.0, radius - overlap, 6.0});
        if (way == 0.0) way = gone;
        EXPECT_NEAR(gone, way, 1e-6 * way);
    }
}

/// A sphere held between six heavy ones turns with `spin`; what is left of that after a window of
/// 94 sub-steps of pi/20 w, as `contact.md_substeps: 20` takes them. `ratio`: M R^2/I.
double spin_left(double ratio, double share, double spin) {
    const double overlap = 1e-3;
    std::vector<nscd::Body> spheres = {soft_sphere(1, {5.0, 5.0, 5.0}, {})};
    spheres[0].inertia = spheres[0].mass * radius * radius / ratio;
    spheres[0].twist.spin = {0.0, 0.0, spin};
    for (int k = 0; k < 6; ++k) {
        Vec3 place{5.0, 5.0, 5.0};
        place[k / 2] += (k % 2 == 0 ? 1.0 : -1.0) * (2.0 * radius - overlap);
        spheres.push_back(soft_sphere(2 + k, place, {}));
        spheres.back().mass = 1e9, spheres.back().inertia = 1e9;
    }
    Settings settings = soft_settings_in_space(1.0, 0.0);
    settings.set("run.md_tangential_share", share);
    SpaceScene scene(settings, spheres);
    scene.play(94, contact_time / 20.0);
    return norm(scene.bodies.twist[0].spin) / spin;
}

// A liquid that takes more of the moment of inertia than of the mass makes tangential springs
// faster than normal ones, unless they are weaker: they then lost friction, since what they
// overshot by each time slid.
TEST(SoftSpheres, InALiquidHaveSpringsThatTheirSubStepsCanFollow) {
    const double spin = 1e-2 * frequency * 1e-3;  // too slow to slide
    EXPECT_LT(spin_left(2.5, tangential_share_of_spheres, spin), 1e-2);
    EXPECT_LT(spin_left(10.0, 1.0 / 11.0, spin), 1e-2);
    EXPECT_GT(spin_left(10.0, tangential_share_of_spheres, spin), 1.0);
}

// The force on one is the opposite of that on the other, in all components, and both are turned
// alike: momentum and the angular momentum of two that meet obliquely in space are kept.
TEST(SoftSpheres, ThatMeetObliquelyKeepMomentumAndAngularMomentum) {
    SpaceScene scene(soft_settings_in_space(0.2, 0.0),
                     {soft_sphere(1, {5.0, 5.0, 5.0}, {1.0, 0.3, -0.2}),
                      soft_sphere(2, {5.67, 5.48, 5.575}, {-0.4, 0.1, 0.5})});
    const auto momentum = [&] {
        Vec3 sum{};
        for (std::size_t i = 0; i < 2; ++i)
            sum = sum + scene.bodies.mass[i] * scene.bodies.twist[i].velocity;
        return sum;
    };
    const auto angular = [&](double lag) {  // positions are half a sub-step ahead
        Vec3 sum{};
        for (std::size_t i = 0; i < 2; ++i) {
            const Twist& twist = scene.bodies.twist[i];
            sum = sum + scene.bodies.world_inertia(i) * twist.spin +
                  cross(scene.bodies.position[i] - lag * twist.velocity,
                        scene.bodies.mass[i] * twist.velocity);
        }
        return sum;
    };
    const Vec3 before = momentum(), spun = angular(0.5 * fine);
    int touched = 0;
    for (int i = 0; i < 4000; ++i) touched += scene.play(1, fine).contacts > 0;
    ASSERT_GT(touched, 100);
    EXPECT_GT(norm(scene.bodies.twist[0].spin), 0.1);
    EXPECT_NEAR(norm(momentum() - before), 0.0, 1e-12);
    EXPECT_NEAR(norm(angular(0.5 * fine) - spun), 0.0, 1e-3 * norm(spun));
}

// Across front and back they meet half-way: equal masses exchange their velocities, each appears on
// the other side, and springs along the contact are kept while it does.
TEST(SoftSpheres, MeetAcrossCyclicSides) {
    const Settings settings =
        cyclic(soft_settings_in_space(0.0, 0.0), "domain.front", "domain.back");
    SpaceScene scene(settings, {soft_sphere(1, {3.0, 5.0, 0.4}, {0.0, 0.0, -1.0}),
                                soft_sphere(2, {3.0, 5.0, 11.3995}, {0.0, 0.0, 0.0})});
    int touching = 0;
    double lowest = 12.0, highest = 0.0;
    for (int i = 0; i < 40; ++i) {
        touching += scene.play(100, fine).contacts > 0;
        for (const Vec3& place : scene.bodies.position)
            lowest = std::min(lowest, place[2]), highest = std::max(highest, place[2]);
    }
    EXPECT_GT(touching, 5);
    EXPECT_NEAR(scene.bodies.twist[0].velocity[2], 0.0, 1e-3);
    EXPECT_NEAR(scene.bodies.twist[1].velocity[2], -1.0, 1e-3);
    EXPECT_GE(lowest, 0.0);
    EXPECT_LT(highest, 12.0);
}

// One that crosses a side keeps its neighbours, and so the spring at the floor.
TEST(SoftSpheres, RollAcrossCyclicSidesAsElsewhere) {
    const Settings settings =
        cyclic(soft_settings_in_space(1.0, 1.0), "domain.front", "domain.back");
    const double overlap = 1.0 / (frequency * frequency);
    const Vec3 inside{5.0, radius - overlap, 6.0}, near_side{9.0, radius - overlap, 11.99};
    SpaceScene scene(settings, {soft_sphere(1, inside, {0.0, 0.0, 0.3}),
                                soft_sphere(2, near_side, {0.0, 0.0, 0.3})});
    scene.play(4000, 1e-4);
    EXPECT_LT(scene.bodies.position[1][2], 1.0);  // it has crossed
    EXPECT_NEAR(scene.bodies.twist[1].velocity[2], scene.bodies.twist[0].velocity[2], 1e-12);
    EXPECT_NEAR(scene.bodies.position[1][2] + 12.0 - near_side[2],
                scene.bodies.position[0][2] - inside[2], 1e-10);
}

TEST(SoftSpheres, HaveAFrontAndABack) {
    SpaceScene scene(soft_settings_in_space(0.0, 0.0),
                     {soft_sphere(1, {3.0, 5.0, 0.5005}, {0.0, 0.0, -1.0}),
                      soft_sphere(2, {6.0, 5.0, 11.4995}, {0.0, 0.0, 1.0})});
    scene.play(4000, fine);
    EXPECT_NEAR(scene.bodies.twist[0].velocity[2], 1.0, 1e-3);
    EXPECT_NEAR(scene.bodies.twist[1].velocity[2], -1.0, 1e-3);
}

}  // namespace
}  // namespace turbidite::soft
