// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/shapes/surface_gap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace turbidite {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

double distance(const Point2& a, const Point2& b) {
    return std::hypot(b[0] - a[0], b[1] - a[1]);
}

/// Distance to the segment a + t (b - a), 0 <= t <= 1.
double distance_to_side(const Point2& a, const Point2& b, const Point2& point) {
    const double dx = b[0] - a[0], dy = b[1] - a[1];
    const double place = ((point[0] - a[0]) * dx + (point[1] - a[1]) * dy) / (dx * dx + dy * dy);
    const double t = std::clamp(place, 0.0, 1.0);
    return distance({a[0] + t * dx, a[1] + t * dy}, point);
}

/// Signed distance of a point from the side that starts at corner i, positive outside.
double height(const std::vector<Point2>& corners, std::size_t i, const Point2& point) {
    const Point2 &a = corners[i], &b = corners[(i + 1) % corners.size()];
    return ((b[1] - a[1]) * (point[0] - a[0]) - (b[0] - a[0]) * (point[1] - a[1])) / distance(a, b);
}

/// Maximum over the sides of the minimum signed distance of the points.
// Separating axes: positive where a side has all points beyond it, else minus the least push along
// a normal that brings them there.
double separation(const std::vector<Point2>& corners, const std::vector<Point2>& points) {
    double largest = -infinite;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        double least = infinite;
        for (const Point2& point : points) least = std::min(least, height(corners, i, point));
        largest = std::max(largest, least);
    }
    return largest;
}

double least_distance(const std::vector<Point2>& corners, const std::vector<Point2>& points) {
    double least = infinite;
    for (std::size_t i = 0; i < corners.size(); ++i)
        for (const Point2& point : points)
            least = std::min(
                least, distance_to_side(corners[i], corners[(i + 1) % corners.size()], point));
    return least;
}

double gap_to_disc(const std::vector<Point2>& corners, const PlacedOutline& disc) {
    // A plate has no inside: a point on its line, beyond its end, is on neither side of it.
    const double depth = corners.size() == 2 ? infinite : separation(corners, {disc.centre});
    // Beyond a corner the line along a side is nearer than the polygon: hence the true distance
    // outside.
    return (depth > 0.0 ? least_distance(corners, {disc.centre}) : depth) - disc.radius;
}

}  // namespace

PlacedOutline placed(const std::vector<Point2>& outline, const Point2& centre, double radius,
                     double angle) {
    PlacedOutline grain{centre, radius, {}};
    // x = centre + R turn(angle) v
    const double c = radius * std::cos(angle), s = radius * std::sin(angle);
    for (const Point2& v : outline)
        grain.corners.push_back({centre[0] + c * v[0] - s * v[1], centre[1] + s * v[0] + c * v[1]});
    return grain;
}

double surface_gap(const PlacedOutline& one, const PlacedOutline& other) {
    if (one.corners.empty() && other.corners.empty())
        return distance(one.centre, other.centre) - one.radius - other.radius;
    if (one.corners.empty()) return gap_to_disc(other.corners, one);
    if (other.corners.empty()) return gap_to_disc(one.corners, other);
    const double depth =
        std::max(separation(one.corners, other.corners), separation(other.corners, one.corners));
    // In the plane the normals of both are all the axes that can separate convex polygons.
    if (depth <= 0.0) return depth;
    return std::min(least_distance(one.corners, other.corners),
                    least_distance(other.corners, one.corners));
}

std::array<double, 4> reach(const PlacedOutline& grain) {
    if (grain.corners.empty()) return {grain.radius, grain.radius, grain.radius, grain.radius};
    std::array<double, 4> most{-infinite, -infinite, -infinite, -infinite};
    for (const Point2& corner : grain.corners)
        for (int axis = 0; axis < 2; ++axis) {
            const double arm = corner[axis] - grain.centre[axis];
            most[2 * axis] = std::max(most[2 * axis], arm);
            most[2 * axis + 1] = std::max(most[2 * axis + 1], -arm);
        }
    return most;
}

}  // namespace turbidite
