// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/shapes/convex_polygon.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace turbidite {
namespace {

/// ShapeRecord vertices of the polygon with these corners.
std::vector<double> record_of(const std::vector<double>& corners) {
    std::vector<double> vertices;
    for (const Point2& v : normalised_outline(corners).vertices)
        vertices.insert(vertices.end(), v.begin(), v.end());
    return vertices;
}

// Side s = sqrt(3) R: area sqrt(3)/4 s^2, moment about the centre area s^2/12.
TEST(Triangle, HasTheClosedFormMoments) {
    const auto triangle = make_shape({"triangle", {}});
    const double radius = 0.75, side = std::sqrt(3.0) * radius;
    const double area = std::sqrt(3.0) / 4.0 * side * side;
    EXPECT_NEAR(triangle->volume(radius), area, 1e-15);
    EXPECT_NEAR(triangle->inertia_per_density(radius)(2, 2), area * side * side / 12.0, 1e-15);
    EXPECT_EQ(triangle->outline().size(), 3u);
}

// Counting random points inside must agree with the closed forms; 1e6 points leave about 0.2 %.
TEST(ConvexPolygon, VolumeAndInertiaAgreeWithMonteCarlo) {
    const auto shape =
        make_shape({"polygon", record_of({0, 0, 3, 0.2, 4, 1.5, 2.5, 2.8, 0.4, 2.1})});
    const double radius = 0.7;
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> coordinate(-radius, radius);
    const int n = 1'000'000;
    double inside = 0.0, x = 0.0, y = 0.0, second = 0.0;
    for (int i = 0; i < n; ++i) {
        const Eigen::Vector3d point(coordinate(random), coordinate(random), 0.0);
        if (!shape->contains(point, radius)) continue;
        inside += 1.0, x += point.x(), y += point.y(), second += point.squaredNorm();
    }
    const double cell = 4.0 * radius * radius / n;
    EXPECT_NEAR(inside * cell / shape->volume(radius), 1.0, 5e-3);
    EXPECT_NEAR(second * cell / shape->inertia_per_density(radius)(2, 2), 1.0, 5e-3);
    EXPECT_NEAR(x / inside, 0.0, 2e-3);
    EXPECT_NEAR(y / inside, 0.0, 2e-3);
}

double distance_to_outline(const ConvexPolygon& shape, double radius, const Eigen::Vector3d& p) {
    double least = 1e300;
    const auto corners = shape.outline();
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Point2 &v = corners[i], &w = corners[(i + 1) % corners.size()];
        const Eigen::Vector3d a(radius * v[0], radius * v[1], 0),
            b(radius * w[0], radius * w[1], 0);
        const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
        least = std::min(least, (a + t * (b - a) - p).norm());
    }
    return least;
}

// A sharp kite (20 degrees at its tip): points of its two long sides come close to each other.
TEST(ConvexPolygon, SurfacePointsKeepTheirDistanceAndIncludeCorners) {
    const ConvexPolygon kite(record_of({0, 0, 2.7, -0.5, 3.2, 0, 2.7, 0.5}));
    for (const double spacing : {0.02, 0.05, 0.11}) {
        const double radius = 0.6;
        const auto points = kite.surface_points(radius, spacing);
        for (std::size_t i = 0; i < points.size(); ++i) {
            EXPECT_NEAR(points[i].normal.norm(), 1.0, 1e-14);
            EXPECT_NEAR(distance_to_outline(kite, radius, points[i].position), 0.0, 1e-14);
            EXPECT_FALSE(kite.contains(points[i].position + 1e-6 * points[i].normal, radius));
            for (std::size_t j = 0; j < i; ++j)
                EXPECT_GE((points[i].position - points[j].position).norm(), spacing * (1 - 1e-11));
        }
        const auto corners = kite.outline();
        for (const Point2& corner : corners)
            EXPECT_TRUE(std::any_of(points.begin(), points.end(), [&](const SurfacePoint& p) {
                return std::hypot(p.position.x() - radius * corner[0],
                                  p.position.y() - radius * corner[1]) < 1e-14;
            }));
    }
}

// Side sqrt(3) R = 1.299 with spacing 0.1: 12 parts, so 3 corners and 3 x 11 points between them.
TEST(Triangle, SurfacePointsFillTheSides) {
    const auto triangle = make_shape({"triangle", {}});
    EXPECT_EQ(triangle->surface_points(0.75, 0.1).size(), 36u);
    EXPECT_EQ(triangle->surface_points(0.75, 1.2).size(), 3u);
    EXPECT_EQ(triangle->surface_points(0.75, 2.0).size(), 1u);
}

TEST(ConvexPolygon, RefusesRecordsThatAreNotNormalised) {
    EXPECT_THROW(make_shape({"polygon", {}}), std::invalid_argument);
    EXPECT_THROW(make_shape({"polygon", {0, 0, 3, 0, 0, 3}}), std::invalid_argument);
    EXPECT_THROW(make_shape({"polygon", {1, 0, 0, -1, -1, 0, 0, 1}}), std::invalid_argument);
    EXPECT_NO_THROW(make_shape({"polygon", {1, 0, 0, 1, -1, 0, 0, -1}}));
}

}  // namespace
}  // namespace turbidite
