// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Free velocities and mobilities from the fluid's responses, in space.
#include "granular_adapter/nscd_adapter/free_motion.hpp"

#include <gtest/gtest.h>

#include "coupler/protocol/failure.hpp"

namespace turbidite {
namespace {

nscd::Bodies two_spheres() {
    nscd::Bodies bodies;
    for (GrainId id : {7, 3}) {
        nscd::Body body;
        body.id = id;
        body.radius = body.mass = 1.0;
        body.inertia = 0.4;
        bodies.add(body);
    }
    return bodies;
}

FreeResponse response(GrainId id, const Vec3& linear, const Vec3& angular) {
    FreeResponse r;
    r.id = id;
    r.velocity = {1.0, 2.0, 3.0};
    r.angular_velocity = {4.0, 5.0, 6.0};
    for (std::size_t i = 0; i < 3; ++i) {
        r.inertia[upper_entry(i, i)] = linear[i];
        r.inertia[upper_entry(i + 3, i + 3)] = angular[i];
    }
    return r;
}

const std::string when = "in window 1";

TEST(FreeMotion, InSpaceItIsIsotropicAndOfThreeComponents) {
    const nscd::Bodies bodies = two_spheres();
    const FreeMotion free = free_motion(
        bodies, {response(3, {2, 2, 2}, {0.5, 0.5, 0.5}), response(7, {4, 5, 3}, {1, 2, 3})}, when,
        3);
    const auto& mobilities = std::get<std::vector<nscd::SpaceMobility>>(free.mobilities);
    ASSERT_EQ(mobilities.size(), 2u);
    EXPECT_DOUBLE_EQ(mobilities[0].linear, 0.25) << "grain 7: the mean of 4, 5, 3";
    EXPECT_DOUBLE_EQ(mobilities[0].angular, 0.5);
    EXPECT_DOUBLE_EQ(mobilities[1].linear, 0.5);
    EXPECT_DOUBLE_EQ(mobilities[1].angular, 2.0);
    EXPECT_EQ(free.velocities[0].velocity, (Vec3{1.0, 2.0, 3.0}));
    EXPECT_EQ(free.velocities[1].spin, (Vec3{4.0, 5.0, 6.0}));
}

TEST(FreeMotion, InThePlaneItStaysInThePlane) {
    const nscd::Bodies bodies = two_spheres();
    const FreeMotion free = free_motion(
        bodies, {response(3, {2, 2, 2}, {1, 1, 1}), response(7, {2, 2, 2}, {1, 1, 4})}, when, 2);
    const auto& mobilities = std::get<std::vector<nscd::PlanarTensor>>(free.mobilities);
    EXPECT_DOUBLE_EQ(mobilities[0].ss, 0.25);
    EXPECT_EQ(free.velocities[0].velocity, (Vec3{1.0, 2.0, 0.0}));
    EXPECT_EQ(free.velocities[0].spin, (Vec3{0.0, 0.0, 6.0}));
}

TEST(FreeMotion, FixedGrainsHaveNoMobilityAndBadInertiaIsRefused) {
    nscd::Bodies bodies = two_spheres();
    bodies.fixed[0] = 1;
    const FreeResponse good = response(3, {2, 2, 2}, {1, 1, 1});
    const FreeMotion free = free_motion(bodies, {response(7, {}, {}), good}, when, 3);
    EXPECT_TRUE(is_immovable(std::get<std::vector<nscd::SpaceMobility>>(free.mobilities)[0]));
    EXPECT_THROW(free_motion(bodies, {response(7, {2, 2, 2}, {1, 1, 1}), good}, when, 3),
                 std::runtime_error)
        << "fixed in the host alone";
    bodies.fixed[0] = 0;
    EXPECT_THROW(free_motion(bodies, {response(7, {2, -2, 2}, {1, 1, 1}), good}, when, 3),
                 PhysicsRefused);
    EXPECT_THROW(free_motion(bodies, {response(7, {2, 2, 2}, {1, 0, 1}), good}, when, 3),
                 PhysicsRefused);
}

}  // namespace
}  // namespace turbidite
