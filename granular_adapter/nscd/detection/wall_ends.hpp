// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Whether a wall with ends may end on another one, where the surface then goes on: what segments of
// the plane (plane/plate_joints.hpp) and rectangles (space/rectangle_joints.hpp) have in common.
#pragma once

#include <algorithm>
#include <cmath>

#include "coupler/rigid/vec3.hpp"
#include "granular_adapter/nscd/problem/walls.hpp"

namespace turbidite::nscd {

/// Rounding of places of one wall on another: of the size of the larger; a half-space has none [m].
inline double rounding_on(const Wall& own, const Wall& other) {
    return 1e-9 * (has_ends(other) ? std::max(size_of(own), size_of(other)) : size_of(own));
}

/// Whether a segment or rectangle may end on another one or on a half-space: it is near enough, and
/// not thicker. A thicker one ends with an edge of its own.
inline bool may_end_on(const Wall& own, const Wall& other) {
    const auto half = [](const Wall& wall) {
        return std::hypot(wall.half_length, wall.half_width);
    };
    const double rounding = rounding_on(own, other);
    return own.half_thickness <= other.half_thickness + rounding &&
           norm(other.point - own.point) <= half(own) + half(other) + rounding;
}

/// Cosine above which another wall leads nearer to a body from an end: two points for one where it
/// just does, so that rounding never leaves none.
constexpr double leads_nearer = 1e-9;

}  // namespace turbidite::nscd
