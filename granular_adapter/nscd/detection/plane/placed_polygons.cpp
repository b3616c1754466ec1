// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/detection/plane/placed_polygons.hpp"

#include <algorithm>

#include "coupler/shapes/shape.hpp"

namespace turbidite::nscd {
namespace {

constexpr int rows = 5;

PolygonShapes::UnitPolygon unit_polygon(const std::vector<Point2>& outline) {
    PolygonShapes::UnitPolygon unit;
    const std::size_t n = outline.size();
    unit.corners = static_cast<int>(n);
    unit.numbers.resize(rows * n);
    unit.in_radius = n > 0 ? 1.0 : 0.0;
    for (std::size_t k = 0; k < n; ++k) {
        const Point2 &a = outline[k], &b = outline[(k + 1) % n];
        const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
        // Counter-clockwise, so the outside is on the right of the direction from a to b.
        const double nx = (b[1] - a[1]) / length, ny = (a[0] - b[0]) / length;
        const double support = nx * a[0] + ny * a[1];
        const double values[rows] = {a[0], a[1], nx, ny, support};
        for (std::size_t row = 0; row < rows; ++row) unit.numbers[row * n + k] = values[row];
        // The centre of mass lies inside, so every support is positive and the smallest is the
        // radius of a circle about it within the outline.
        unit.in_radius = std::min(unit.in_radius, support);
    }
    return unit;
}

}  // namespace

PolygonShapes::PolygonShapes(const ShapeTable& shapes) {
    for (const ShapeRecord& record : shapes) {
        polygons_.push_back(unit_polygon(make_shape(record)->outline()));
        any_ = any_ || polygons_.back().corners > 0;
    }
}

PlacedPolygons::PlacedPolygons(const PolygonShapes& shapes, const Bodies& bodies)
    : shapes_(shapes), bodies_(bodies) {
    if (!shapes.any()) return;
    first_.reserve(bodies.size());
    std::size_t total = 0;
    for (const std::int32_t shape : bodies.shape) {
        first_.push_back(total);
        total += static_cast<std::size_t>(rows * shapes[shape].corners);
    }
    numbers_.resize(total);
    for (std::size_t i = 0; i < bodies.size(); ++i) place(i);
}

// A quaternion (w, 0, 0, z) rotates by the angle of cosine w^2 - z^2 and sine 2 w z; both are
// divided by w^2 + z^2, which rounding may have changed from 1.
void PlacedPolygons::place(std::size_t body) {
    const PolygonShapes::UnitPolygon& unit = shapes_[bodies_.shape[body]];
    const Quaternion& q = bodies_.orientation[body];
    const double square = q[0] * q[0] + q[3] * q[3], radius = bodies_.radius[body];
    const double c = (q[0] * q[0] - q[3] * q[3]) / square, s = 2.0 * q[0] * q[3] / square;
    const int n = unit.corners;
    const double* from = unit.numbers.data();
    double* to = numbers_.data() + first_[body];
    for (int k = 0; k < n; ++k) {
        to[k] = radius * (c * from[k] - s * from[n + k]);
        to[n + k] = radius * (s * from[k] + c * from[n + k]);
        to[2 * n + k] = c * from[2 * n + k] - s * from[3 * n + k];
        to[3 * n + k] = s * from[2 * n + k] + c * from[3 * n + k];
        to[4 * n + k] = radius * from[4 * n + k];
    }
}

}  // namespace turbidite::nscd
