// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The Delaunay tessellation of points in the plane, as the dual of Boost.Polygon's Voronoi diagram,
// whose predicates are exact on integers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace turbidite {

/// Coordinates on a grid; |x|, |y| at most 2^30 keeps every difference within 32 bits.
struct GridPoint {
    std::int32_t x = 0;
    std::int32_t y = 0;
};

/// The cells whose circumscribed circle holds no other point: indices of their vertices,
/// counter-clockwise; three, or more where points lie on one circle. Only one of several coincident
/// points is used. Fewer than three points, or points on a line, have no cells.
std::vector<std::vector<std::size_t>> delaunay_cells(const std::vector<GridPoint>& points);

}  // namespace turbidite
