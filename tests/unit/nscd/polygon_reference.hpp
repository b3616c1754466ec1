// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Distance and penetration of convex polygons by exhaustion, in long double: the reference for
// contact detection.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "granular_adapter/nscd/detection/plane/placed_polygons.hpp"

namespace turbidite::nscd::reference {

struct Point {
    long double x, y;
};
using Outline = std::vector<Point>;

inline Outline outline(const PolygonView& polygon, const Vec3& at) {
    Outline points;
    for (int k = 0; k < polygon.corners; ++k)
        points.push_back({static_cast<long double>(at[0]) + polygon.x[k],
                          static_cast<long double>(at[1]) + polygon.y[k]});
    return points;
}

inline long double to_segment(const Point& a, const Point& b, const Point& p) {
    const long double dx = b.x - a.x, dy = b.y - a.y;
    const long double t =
        std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / (dx * dx + dy * dy), 0.0L, 1.0L);
    return std::hypot(a.x + t * dx - p.x, a.y + t * dy - p.y);
}

/// Smallest distance of a point from the sides.
inline long double to_sides(const Outline& a, const Point& p) {
    long double least = INFINITY;
    for (std::size_t i = 0; i < a.size(); ++i)
        least = std::min(least, to_segment(a[i], a[(i + 1) % a.size()], p));
    return least;
}

/// max over sides of a of min over points of b of the height.
inline long double separation(const Outline& a, const Outline& b) {
    long double largest = -INFINITY;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const Point &p = a[i], &q = a[(i + 1) % a.size()];
        const long double length = std::hypot(q.x - p.x, q.y - p.y);
        long double least = INFINITY;
        for (const Point& v : b)
            least =
                std::min(least, ((q.y - p.y) * (v.x - p.x) - (q.x - p.x) * (v.y - p.y)) / length);
        largest = std::max(largest, least);
    }
    return largest;
}

/// Distance, or minus the smallest displacement that separates the polygons.
inline long double gap(const Outline& a, const Outline& b) {
    const long double depth = std::max(separation(a, b), separation(b, a));
    if (depth <= 0.0L) return depth;
    long double least = INFINITY;
    for (const Point& v : b) least = std::min(least, to_sides(a, v));
    for (const Point& v : a) least = std::min(least, to_sides(b, v));
    return least;
}

}  // namespace turbidite::nscd::reference
