// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Where two convex polygons meet: one point or two, each with its own gap and normal.
//
// Of all sides of both, the one over which the other polygon lies highest (its lowest corner's
// height, the separation) is the reference; the incident side is the one at that corner which faces
// it most. In the frame of the reference side, 0 <= t <= L along it and height h above it:
//
//     corner over side      the lowest corner; gap h along the reference's normal
//     corner before corner  the lowest corner lies outside [0, L] and h > 0: normal along the line
//                           between the two corners, gap their distance
//     side on side          the other end of the part of the incident side above [0, L] is a second
//                           point where its h is below the alert distance
//
// The first point's gap is the exact distance while the polygons are apart: the separation as a
// function of direction is quasi-concave where it is positive, so the best side ends at the nearest
// pair of corners. When they overlap, its gap is minus the least displacement that parts them.
//
// Every point is named by a corner: of the end of an overlap of two sides, one polygon's corner is
// the reason, whichever of the two is the reference. Names thus stay when the reference changes, as
// it does by rounding between sides that lie flat on each other. Where a corner of each is at the
// end, within 1 % of the smaller radius, the first polygon's gives the name.
#pragma once

#include <array>

#include "granular_adapter/nscd/detection/plane/placed_polygons.hpp"

namespace turbidite::nscd {

struct ManifoldPoint {
    double x = 0.0, y = 0.0;    ///< half-way across the gap, from the centre of the first [m]
    double nx = 0.0, ny = 0.0;  ///< unit, from the first to the second
    double gap = 0.0;           ///< [m]
    double length = 0.0;        ///< of the common side: half of it for each of two points, else 0
    int corner = 0;             ///< the corner that names the point
    bool of_second = false;     ///< of the second polygon
    int turns_with = 0;         ///< the normal: 1 with the first's side, 2 the second's, 0 neither
};

struct Manifold {
    std::array<ManifoldPoint, 2> points;
    int count = 0;
};

/// `ox`, `oy`: centre of the second minus that of the first [m]. Points with gaps below `alert`
/// only. Where both polygons could be the reference, the first is.
Manifold polygon_manifold(const PolygonView& first, const PolygonView& second, double ox, double oy,
                          double alert);

}  // namespace turbidite::nscd
