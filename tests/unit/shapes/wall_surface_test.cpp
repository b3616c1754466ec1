// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/shapes/wall_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "coupler/shapes/tight_wall.hpp"

namespace turbidite {
namespace {

SpaceWall wall_of(SpaceWallKind kind) {
    SpaceWall wall;
    wall.kind = kind;
    wall.place = wall.pivot = {1.0, 2.0, 3.0};
    // Edges of length 3 and 6 at a right angle
    wall.a = {2.0, -1.0, 2.0};
    wall.b = {2.0, 4.0, 4.0};
    wall.b = wall.b - (dot(wall.b, wall.a) / 9.0) * wall.a;
    wall.radius = 0.7;
    wall.radius2 = 1.9;
    wall.motion = constant_motion({});
    return wall;
}

const SpaceWallKind kinds[] = {SpaceWallKind::plate, SpaceWallKind::cylinder, SpaceWallKind::cone,
                               SpaceWallKind::ring};

/// A point of the surface by two parameters from 0 to 1.
Vec3 point_on(const SpaceWall& wall, double s, double t) {
    if (wall.kind == SpaceWallKind::plate) return wall.place + s * wall.a + t * wall.b;
    const Vec3 axis = wall.a / norm(wall.a), one = wall.b / norm(wall.b), two = cross(axis, one);
    const double angle = 2.0 * std::numbers::pi * t;
    const bool wider = wall.kind != SpaceWallKind::cylinder;
    const double radius = wider ? wall.radius + s * (wall.radius2 - wall.radius) : wall.radius;
    const Vec3 along = wall.kind == SpaceWallKind::ring ? Vec3{} : s * wall.a;
    return wall.place + along + radius * (std::cos(angle) * one + std::sin(angle) * two);
}

double least_distance(const SpaceWall& wall, const Vec3& from) {
    double least = 1e9;
    for (int s = 0; s <= 200; ++s)
        for (int t = 0; t <= 400; ++t)
            least = std::min(least, norm(point_on(wall, s / 200.0, t / 400.0) - from));
    return least;
}

TEST(WallSurface, DistanceIsThatOfTheNearestPoint) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> x(-3.0, 8.0);
    for (const SpaceWallKind kind : kinds) {
        const SpaceWall wall = wall_of(kind);
        for (int trial = 0; trial < 8; ++trial) {
            const Vec3 from{x(random), x(random), x(random)};
            EXPECT_NEAR(distance(surface_of(wall), from), least_distance(wall, from), 0.01);
        }
        EXPECT_NEAR(distance(surface_of(wall), point_on(wall, 0.3, 0.2)), 0.0, 1e-12);
    }
}

TEST(WallSurface, ItsBoxIsTheSmallest) {
    for (const SpaceWallKind kind : kinds) {
        const SpaceWall wall = wall_of(kind);
        const Extent all = extent_of(surface_of(wall), 0.25);
        Vec3 low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
        for (const double s : {0.0, 0.5, 1.0})
            for (int t = 0; t <= 1000; ++t)
                for (int axis = 0; axis < 3; ++axis) {
                    const double at = point_on(wall, s, t / 1000.0)[axis];
                    low[axis] = std::min(low[axis], at);
                    high[axis] = std::max(high[axis], at);
                }
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(all.low[axis], low[axis] - 0.25, 1e-4);
            EXPECT_NEAR(all.high[axis], high[axis] + 0.25, 1e-4);
        }
    }
}

/// The points of the wall as they move: its surface goes with them.
TEST(WallSurface, GoesWhereTheMotionTakesIt) {
    for (const SpaceWallKind kind : kinds) {
        SpaceWall wall = wall_of(kind);
        wall.pivot = {0.5, 2.5, 3.5};
        const Twist rate{{0.4, -0.3, 0.2}, {0.5, 0.6, -0.7}};
        wall.motion = constant_motion(rate);
        const double time = 1.7;
        const PlacedWall placed = place(wall, time, 0.1);
        EXPECT_EQ(placed.twist, rate);
        EXPECT_LT(norm(placed.pivot - wall.pivot - time * rate.velocity), 1e-12);
        const Rotation turn = rotation(time * rate.spin);
        for (const auto& [s, t] : {std::pair{0.2, 0.1}, std::pair{0.9, 0.6}}) {
            const Vec3 now = placed.pivot + turn(point_on(wall, s, t) - wall.pivot);
            EXPECT_NEAR(distance(placed.surface, now), 0.0, 1e-12);
        }
    }
}

/// Whatever the angle: what lies at its side is as before to the last digit.
TEST(WallSurface, ATurnAboutItsAxisLeavesARoundOneWhereItIs) {
    for (const SpaceWallKind kind : kinds) {
        SpaceWall wall = wall_of(kind);
        wall.pivot = wall.place + 0.4 * wall.a;
        wall.motion = constant_motion({{}, 1.3 * wall.a});
        const bool stays = place(wall, 2.1, 0.1).surface == surface_of(wall);
        EXPECT_EQ(stays, kind != SpaceWallKind::plate);
        wall.pivot = wall.pivot + Vec3{0.0, 0.0, 0.01};
        EXPECT_FALSE(place(wall, 2.1, 0.1).surface == surface_of(wall));
    }
}

/// Rows of 1 D above very small ones: the least thickness is twice the largest |n_y|.
TEST(TightWall, HasTwoRowsAlongItsMostUprightNormal) {
    MeshRows rows;
    rows.height = 1e-3;
    rows.stretched = {1.0};
    const auto normal = [&](SpaceWallKind kind) {
        return 0.5 * least_thickness(surface_of(wall_of(kind)), 0.1, rows);
    };
    const SpaceWall plate = wall_of(SpaceWallKind::plate);
    const Vec3 across = cross(plate.a, plate.b);
    EXPECT_NEAR(normal(SpaceWallKind::plate), std::abs(across[1]) / norm(across), 1e-12);
    // The axis is (2, -1, 2)/3; the cone is 3 long and gets wider by 1.2.
    const double circle = std::sqrt(8.0 / 9.0);
    EXPECT_NEAR(normal(SpaceWallKind::ring), 1.0 / 3.0, 1e-12);
    EXPECT_NEAR(normal(SpaceWallKind::cylinder), circle, 1e-12);
    EXPECT_NEAR(normal(SpaceWallKind::cone), (3.0 * circle + 0.4) / std::hypot(3.0, 1.2), 1e-12);
}

}  // namespace
}  // namespace turbidite
