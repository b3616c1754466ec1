// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/shapes/convex_polygon.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace turbidite {
namespace {

constexpr double rounding = 1e-9;

void demand_normalised(const Outline& outline) {
    const bool centred = std::hypot(outline.centre[0], outline.centre[1]) <= rounding;
    if (outline.turned_round || !centred || std::abs(outline.radius - 1.0) > rounding)
        throw std::invalid_argument(
            "polygon: the vertices must run counter-clockwise about the centre of mass with "
            "circumscribed radius 1");
}

Eigen::Vector3d spatial(const Point2& v) {
    return {v[0], v[1], 0.0};
}

/// Adds a point unless an existing one is too near.
void add_point(std::vector<SurfacePoint>& points, const SurfacePoint& point, double spacing) {
    const auto too_near = [&](const SurfacePoint& other) {
        // The rounding keeps points that are exactly `spacing` apart.
        return (other.position - point.position).norm() < spacing * (1.0 - 1e-12);
    };
    if (std::none_of(points.begin(), points.end(), too_near)) points.push_back(point);
}

}  // namespace

ConvexPolygon::ConvexPolygon(const std::vector<double>& vertices) {
    demand_normalised(normalised_outline(vertices));
    for (std::size_t i = 0; i < vertices.size(); i += 2)
        vertices_.push_back({vertices[i], vertices[i + 1]});
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
        const Point2 &a = vertices_[i], &b = vertices_[(i + 1) % vertices_.size()];
        const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
        // The side turned clockwise by a quarter: outward, since the vertices run
        // counter-clockwise.
        normals_.push_back({(b[1] - a[1]) / length, (a[0] - b[0]) / length});
    }
    const AreaMoments moments = area_moments(vertices_);
    area_ = moments.area;
    second_moment_ = moments.second;
}

double ConvexPolygon::volume(double radius) const {
    // V = R^2 V(1)
    return area_ * radius * radius;
}

Eigen::Matrix3d ConvexPolygon::inertia_per_density(double radius) const {
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
    const double square = radius * radius;
    // I_zz / rho = R^4 I_zz(1): the integral of |x|^2 over an area.
    inertia(2, 2) = second_moment_ * square * square;
    return inertia;
}

double ConvexPolygon::beyond(std::size_t side, const Eigen::Vector3d& point, double radius) const {
    const Point2 &v = vertices_[side], &n = normals_[side];
    // n . (x - R v)
    return n[0] * (point.x() - radius * v[0]) + n[1] * (point.y() - radius * v[1]);
}

bool ConvexPolygon::contains(const Eigen::Vector3d& point, double radius) const {
    for (std::size_t i = 0; i < vertices_.size(); ++i)
        // Convex: inside of all sides is inside.
        if (beyond(i, point, radius) > on_the_edge * radius) return false;
    return true;
}

double ConvexPolygon::least_distance(const Eigen::Vector3d& point, double radius) const {
    double distance = 0.0;
    for (std::size_t i = 0; i < vertices_.size(); ++i)
        distance = std::max(distance, beyond(i, point, radius));
    return distance;
}

double ConvexPolygon::extent(const Eigen::Vector3d& direction, double radius) const {
    double extent = 0.0;
    for (const Point2& v : vertices_)
        extent = std::max(extent, radius * (v[0] * direction.x() + v[1] * direction.y()));
    return extent;
}

std::vector<SurfacePoint> ConvexPolygon::surface_points(double radius, double spacing) const {
    const std::size_t n = vertices_.size();
    std::vector<SurfacePoint> points;
    for (std::size_t i = 0; i < n; ++i) {
        const Eigen::Vector3d bisector = spatial(normals_[i]) + spatial(normals_[(i + n - 1) % n]);
        add_point(points, {radius * spatial(vertices_[i]), bisector.normalized()}, spacing);
    }
    for (std::size_t i = 0; i < n; ++i) {
        const Eigen::Vector3d first = radius * spatial(vertices_[i]);
        const Eigen::Vector3d side = radius * spatial(vertices_[(i + 1) % n]) - first;
        // As many equal parts as leave each at least `spacing` long; their inner ends become
        // points.
        const int parts = static_cast<int>(std::floor(side.norm() / spacing * (1.0 + 1e-12)));
        for (int k = 1; k < parts; ++k)
            add_point(points,
                      {first + (static_cast<double>(k) / parts) * side, spatial(normals_[i])},
                      spacing);
    }
    return points;
}

}  // namespace turbidite
