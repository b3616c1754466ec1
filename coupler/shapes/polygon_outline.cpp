// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/shapes/polygon_outline.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace turbidite {
namespace {

// Distances below this fraction of the outline's extent count as zero: far above rounding, far
// below any intended length.
constexpr double least_share = 1e-9;

Point2 minus(const Point2& a, const Point2& b) {
    return {a[0] - b[0], a[1] - b[1]};
}

double cross(const Point2& a, const Point2& b) {
    return a[0] * b[1] - a[1] * b[0];
}

double length(const Point2& a) {
    return std::hypot(a[0], a[1]);
}

std::string vertex_name(const std::vector<Point2>& vertices, std::size_t i) {
    char text[96];
    std::snprintf(text, sizeof text, "vertex %zu (%.6g, %.6g)", i + 1, vertices[i][0],
                  vertices[i][1]);
    return text;
}

[[noreturn]] void refuse(const std::string& fault) {
    throw std::invalid_argument("polygon: " + fault);
}

std::vector<Point2> pairs(const std::vector<double>& coordinates) {
    if (coordinates.size() % 2 != 0)
        refuse("there are " + std::to_string(coordinates.size()) +
               " numbers; every vertex needs x and y");
    std::vector<Point2> vertices;
    for (std::size_t i = 0; i < coordinates.size(); i += 2)
        vertices.push_back({coordinates[i], coordinates[i + 1]});
    if (vertices.size() < 3)
        refuse("there are " + std::to_string(vertices.size()) + " vertices; at least 3 are needed");
    for (std::size_t i = 0; i < vertices.size(); ++i)
        if (!std::isfinite(vertices[i][0]) || !std::isfinite(vertices[i][1]))
            refuse(vertex_name(vertices, i) + " is not finite");
    return vertices;
}

double extent(const std::vector<Point2>& vertices) {
    double largest = 0.0;
    for (const Point2& v : vertices) largest = std::max(largest, length(minus(v, vertices[0])));
    return largest;
}

void check_repeated(const std::vector<Point2>& vertices, double least) {
    for (std::size_t i = 0; i < vertices.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (length(minus(vertices[i], vertices[j])) <= least)
                refuse(vertex_name(vertices, i) + " is the same as vertex " +
                       std::to_string(j + 1) + "; remove it");
}

/// Signed distance of a point from the line from a to b, positive to the left.
double height(const Point2& a, const Point2& b, const Point2& point) {
    return cross(minus(b, a), minus(point, a)) / length(minus(b, a));
}

/// Counter-clockwise vertices: every corner turns left, and every vertex is left of every side.
void check_convex(const std::vector<Point2>& v, double least) {
    const std::size_t n = v.size();
    for (std::size_t i = 0; i < n; ++i) {
        // How far the vertex is left of the line between its neighbours: right of it, at a convex
        // corner.
        const double turn = height(v[(i + n - 1) % n], v[(i + 1) % n], v[i]);
        if (turn > least) refuse(vertex_name(v, i) + " makes it concave; remove or move it");
        if (turn > -least)
            refuse(vertex_name(v, i) + " is collinear with its neighbours; remove it");
    }
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < n; ++k)
            // Corners that all turn left may still go round twice (a pentagram): every side is
            // asked.
            if (k != i && k != (i + 1) % n && height(v[i], v[(i + 1) % n], v[k]) < least)
                refuse(vertex_name(v, k) + " is outside the side from vertex " +
                       std::to_string(i + 1) + " to " + std::to_string((i + 1) % n + 1) +
                       ": the outline intersects itself");
}

}  // namespace

// Green's theorem over the triangles (0, v_i, v_i+1), with the origin at the first vertex: exact
// for polygons, without loss of digits far from the origin.
AreaMoments area_moments(const std::vector<Point2>& vertices) {
    double twice_area = 0.0, x = 0.0, y = 0.0, second = 0.0;
    for (std::size_t i = 1; i + 1 < vertices.size(); ++i) {
        const Point2 a = minus(vertices[i], vertices[0]), b = minus(vertices[i + 1], vertices[0]);
        const double w = cross(a, b);
        twice_area += w;
        // integral of x over the triangle (0, a, b): w (a + b) / 6
        x += w * (a[0] + b[0]);
        y += w * (a[1] + b[1]);
        // integral of |x|^2 over the triangle: w (|a|^2 + a . b + |b|^2) / 12
        second +=
            w * (a[0] * a[0] + a[0] * b[0] + b[0] * b[0] + a[1] * a[1] + a[1] * b[1] + b[1] * b[1]);
    }
    AreaMoments moments;
    moments.area = 0.5 * twice_area;
    const double cx = x / (3.0 * twice_area), cy = y / (3.0 * twice_area);
    moments.centre = {vertices[0][0] + cx, vertices[0][1] + cy};
    moments.second = second / 12.0 - moments.area * (cx * cx + cy * cy);  // parallel axes
    return moments;
}

Outline normalised_outline(const std::vector<double>& coordinates) {
    std::vector<Point2> vertices = pairs(coordinates);
    const double size = extent(vertices), least = least_share * size;
    check_repeated(vertices, least);
    const double area = area_moments(vertices).area;
    if (!(std::abs(area) > least_share * size * size))
        refuse("its area is zero: all vertices are collinear with " + vertex_name(vertices, 0));
    Outline outline;
    outline.turned_round = area < 0.0;
    // The first vertex remains the first.
    if (outline.turned_round) std::reverse(vertices.begin() + 1, vertices.end());
    check_convex(vertices, least);
    outline.centre = area_moments(vertices).centre;
    outline.radius = 0.0;
    for (const Point2& v : vertices)
        outline.radius = std::max(outline.radius, length(minus(v, outline.centre)));
    for (const Point2& v : vertices) {
        const Point2 arm = minus(v, outline.centre);
        outline.vertices.push_back({arm[0] / outline.radius, arm[1] / outline.radius});
    }
    return outline;
}

std::vector<double> equilateral_triangle() {
    const double half_side = 0.5 * std::sqrt(3.0);
    return {0.0, 1.0, -half_side, -0.5, half_side, -0.5};
}

}  // namespace turbidite
