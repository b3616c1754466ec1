// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <random>

#include "coupler/shapes/immersed_body.hpp"

namespace turbidite {
namespace {

// Volume and inertia by counting random points inside must agree with the closed forms; 1e6 points
// have about 0.1 % noise.
TEST(Disc, VolumeAndInertiaAgreeWithMonteCarlo) {
    const auto disc = make_shape({"disc", {}});
    const double radius = 0.7, side = 2.0 * radius;
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> coordinate(-radius, radius);
    const int n = 1'000'000;
    double inside = 0.0, second_moment = 0.0;
    for (int i = 0; i < n; ++i) {
        const Eigen::Vector3d point(coordinate(random), coordinate(random), 0.0);
        if (!disc->contains(point, radius)) continue;
        inside += 1.0;
        second_moment += point.squaredNorm();
    }
    const double cell = side * side / n;
    EXPECT_NEAR(inside * cell / disc->volume(radius), 1.0, 5e-3);
    EXPECT_NEAR(second_moment * cell / disc->inertia_per_density(radius)(2, 2), 1.0, 5e-3);
}

TEST(Disc, SurfacePointsKeepTheirDistance) {
    const auto disc = make_shape({"disc", {}});
    const auto points = disc->surface_points(0.5, 0.1);
    // n = floor(pi / asin(0.1)) = floor(31.36) = 31 chords of at least 0.1.
    ASSERT_EQ(points.size(), 31u);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto& next = points[(i + 1) % points.size()];
        EXPECT_GE((points[i].position - next.position).norm(), 0.1);
        EXPECT_NEAR(points[i].position.dot(points[i].normal), 0.5, 1e-15);
    }
}

TEST(Sphere, VolumeAndInertiaAgreeWithMonteCarlo) {
    const auto sphere = make_shape({"sphere", {}});
    const double radius = 0.7, side = 2.0 * radius;
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> coordinate(-radius, radius);
    const int n = 1'000'000;
    double inside = 0.0, second_moment = 0.0;
    for (int i = 0; i < n; ++i) {
        const Eigen::Vector3d point(coordinate(random), coordinate(random), coordinate(random));
        if (!sphere->contains(point, radius)) continue;
        inside += 1.0;
        second_moment += point.head<2>().squaredNorm();
    }
    const double cell = side * side * side / n;
    EXPECT_EQ(sphere->dimension(), 3);
    EXPECT_NEAR(inside * cell / sphere->volume(radius), 1.0, 5e-3);
    const Eigen::Matrix3d inertia = sphere->inertia_per_density(radius);
    EXPECT_NEAR(second_moment * cell / inertia(2, 2), 1.0, 5e-3);
    EXPECT_EQ(inertia, inertia(0, 0) * Eigen::Matrix3d::Identity());
}

TEST(Sphere, SurfacePointsKeepTheirDistanceAndLeaveNoHole) {
    const auto sphere = make_shape({"sphere", {}});
    const double radius = 0.5, spacing = 0.1;
    const auto points = sphere->surface_points(radius, spacing);
    ASSERT_GT(points.size(), 200u);
    for (const SurfacePoint& point : points) {
        EXPECT_NEAR(point.position.norm(), radius, 1e-15);
        EXPECT_NEAR(point.position.dot(point.normal), radius, 1e-15);
        double nearest = 1.0;
        for (const SurfacePoint& other : points)
            if (&other != &point)
                nearest = std::min(nearest, (other.position - point.position).norm());
        EXPECT_GE(nearest, spacing * (1.0 - 1e-12));
        EXPECT_LE(nearest, 1.5 * spacing);
    }
    EXPECT_EQ(sphere->surface_points(radius, 3.0 * radius).size(), 1u);
}

TEST(Shapes, AnUnknownNameListsTheKnownOnes) {
    try {
        make_shape({"disk", {}});
        FAIL();
    } catch (const std::invalid_argument& error) {
        EXPECT_STREQ(error.what(),
                     "unknown shape \"disk\"; known: disc, triangle, polygon, sphere");
    }
}

// rho_s/rho_f = 1.5: c = 1/3. With R_h = 0.9 R the fluid fills 0.81 of the volume: M_eff = M (1 -
// 0.81/1.5) = 0.46 M, while the weight keeps the true buoyancy, M/3.
TEST(ImmersedBody, FollowsTheDesignsFactors) {
    const auto disc = make_shape({"disc", {}});
    const ImmersedBody full = immersed_body(*disc, 0.5, 1.5, 1.0, 1.0);
    EXPECT_NEAR(full.effective_mass / full.mass, 1.0 / 3.0, 1e-15);
    EXPECT_NEAR(full.effective_inertia(2, 2) / full.inertia(2, 2), 1.0 / 3.0, 1e-15);
    const ImmersedBody reduced = immersed_body(*disc, 0.5, 1.5, 1.0, 0.9);
    EXPECT_NEAR(reduced.effective_mass / reduced.mass, 0.46, 1e-15);
    EXPECT_NEAR(reduced.submerged_mass / reduced.mass, 1.0 / 3.0, 1e-15);
    EXPECT_NEAR(reduced.effective_inertia(2, 2) / reduced.inertia(2, 2),
                1 - 0.9 * 0.9 * 0.9 * 0.9 / 1.5, 1e-15);
    const ImmersedBody neutral = immersed_body(*disc, 0.5, 1.0, 1.0, 1.0);
    EXPECT_NEAR(neutral.effective_mass / neutral.mass, 0.0, 1e-15);
    const ImmersedBody light = immersed_body(*disc, 0.5, 0.5, 1.0, 1.0);
    EXPECT_NEAR(light.effective_mass / light.mass, -1.0, 1e-15);
}

}  // namespace
}  // namespace turbidite
