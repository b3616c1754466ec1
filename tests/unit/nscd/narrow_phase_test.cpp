// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/detection/narrow_phase.hpp"

#include <gtest/gtest.h>

#include "coupler/rigid/vec3.hpp"
#include "scenes.hpp"

namespace turbidite::nscd {
namespace {

std::vector<ContactPoint> against_wall(const Wall& wall, const Vec3& centre, double alert) {
    Bodies bodies;
    bodies.add(scenes::disc(1, centre[0], centre[1]));
    std::vector<ContactPoint> points;
    NarrowPhase(scenes::discs).wall({bodies, 0, wall, 0, alert}, points);
    return points;
}

void expect_near(const Vec3& a, const Vec3& b) {
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(a[axis], b[axis], 1e-15);
}

// Radii 0.5 and 1, centres (0,0) and (1.2, 1.6), 2 apart: gap 0.5, normal (0.6, 0.8); the point
// lies 0.5 + 0.25 from a and 1 + 0.25 from b.
TEST(NarrowPhase, PutsTheContactHalfWayAcrossTheGap) {
    Bodies bodies;
    bodies.add(scenes::disc(1, 0.0, 0.0));
    bodies.add(scenes::disc(2, 1.2, 1.6, 1.0));
    std::vector<ContactPoint> points;
    const NarrowPhase narrow(scenes::discs);
    narrow.pair({bodies, 0, 1, {1.2, 1.6, 0.0}, 0.4}, points);
    EXPECT_TRUE(points.empty());
    narrow.pair({bodies, 0, 1, {1.2, 1.6, 0.0}, 0.6}, points);
    ASSERT_EQ(points.size(), 1u);
    EXPECT_NEAR(points[0].gap, 0.5, 1e-15);
    expect_near(points[0].normal, {0.6, 0.8, 0.0});
    expect_near(points[0].arm_a, {0.45, 0.6, 0.0});
    expect_near(points[0].arm_b, {-0.75, -1.0, 0.0});
}

// A floor at y = 0 and a disc of radius 0.5 centred at y = 0.4: overlap 0.1.
TEST(NarrowPhase, MeasuresOverlapWithAWall) {
    const auto points = against_wall(scenes::floor(0.0), {3.0, 0.4, 0.0}, 0.0);
    ASSERT_EQ(points.size(), 1u);
    EXPECT_NEAR(points[0].gap, -0.1, 1e-15);
    expect_near(points[0].normal, {0.0, 1.0, 0.0});
    expect_near(points[0].arm_b, {0.0, -0.5, 0.0});
}

// Segment |x| <= 1 on y = 0: at x = 1.3, y = 0.4 the corner is at distance 0.5: gap 0, normal (0.6,
// 0.8). The disc is held on the side on which its centre is.
TEST(NarrowPhase, TouchesTheCornersOfASegment) {
    Wall segment = scenes::floor(0.0);
    segment.half_length = 1.0;
    const auto corner = against_wall(segment, {1.3, 0.4, 0.0}, 0.01);
    ASSERT_EQ(corner.size(), 1u);
    EXPECT_NEAR(corner[0].gap, 0.0, 1e-15);
    expect_near(corner[0].normal, {0.6, 0.8, 0.0});
    const auto other = against_wall(segment, {-1.3, 0.4, 0.0}, 0.01);
    ASSERT_EQ(other.size(), 1u);
    EXPECT_NE(other[0].feature, corner[0].feature);
    EXPECT_EQ(against_wall(segment, {0.0, 0.4, 0.0}, 0.01).size(), 1u);
    const auto behind = against_wall(segment, {0.0, -0.4, 0.0}, 0.01);
    ASSERT_EQ(behind.size(), 1u);
    EXPECT_NEAR(behind[0].gap, -0.1, 1e-15);
    expect_near(behind[0].normal, {0.0, -1.0, 0.0});
    EXPECT_TRUE(against_wall(segment, {1.5, 0.4, 0.0}, 0.01).empty());
}

TEST(NarrowPhase, RefusesShapesWithoutContacts) {
    try {
        NarrowPhase(ShapeTable{{"cube", {}}});
        FAIL();
    } catch (const std::invalid_argument& error) {
        EXPECT_NE(std::string(error.what()).find("\"cube\""), std::string::npos);
    }
}

}  // namespace
}  // namespace turbidite::nscd
