// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The contact manifold of two convex polygons: up to four points, each with its own gap and normal.
//
// The reference side is that side, of all sides of both polygons, over which the other polygon lies
// highest; its height is that of its lowest corner (the separation). The incident side is the side
// at that corner which faces the reference most. In the frame of the reference side, 0 <= t <= L
// along it and height h above it:
//
//     corner over side      the lowest corner; gap h along the reference's normal
//     corner before corner  the lowest corner lies outside [0, L] and h > 0: normal along the line
//                           between the two corners, gap their distance
//     side on side          the other end of the part of the incident side above [0, L] is a second
//                           point if its h is below the alert distance
//     beside that side      likewise for the two incident sides next to it, since beside a short
//                           side or at a blunt corner they may close too when the polygon turns
//
// While the polygons are apart, the gap of the first point is their exact distance: the separation
// as a function of direction is quasi-concave where it is positive, so that the best side ends at
// the nearest pair of corners. If they overlap, its gap is minus the smallest displacement that
// separates them.
//
// Every point is named by a corner, since an overlap of two sides ends at a corner of one polygon
// or the other, whichever of them is the reference. Names therefore persist when the reference
// changes, as it does by rounding between sides that lie flat on each other. If corners of both
// polygons are at the end, within 1 % of the smaller radius, the first polygon's gives the name.
#pragma once

#include <array>

#include "granular_adapter/nscd/detection/plane/placed_polygons.hpp"

namespace turbidite::nscd {

struct ManifoldPoint {
    /// half-way across the gap, relative to the centre of the first [m]
    double x = 0.0, y = 0.0;
    double nx = 0.0, ny = 0.0;  ///< unit normal, from the first to the second
    double gap = 0.0;           ///< [m]
    double length = 0.0;        ///< half the common side for each of its two ends, else 0 [m]
    int corner = 0;             ///< the corner that names the point
    bool of_second = false;     ///< whether this corner belongs to the second polygon
    /// Normal fixed to a side of the first (1), of the second (2), or to none (0).
    int turns_with = 0;
};

struct Manifold {
    std::array<ManifoldPoint, 4> points;
    int count = 0;
};

/// `ox`, `oy`: centre of the second minus that of the first [m]. Returns only points with gaps
/// below `alert`. If both polygons could be the reference, it is the first.
Manifold polygon_manifold(const PolygonView& first, const PolygonView& second, double ox, double oy,
                          double alert);

}  // namespace turbidite::nscd
