// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Where two bodies, or a body and a wall, touch or nearly do, and what a detector is asked.
//
// The normal points from a (or the wall) to b. Between bodies both arms end at the same point,
// half-way across the gap, so that an impulse and its reaction have no moment; at a wall the arm
// ends on the body's surface. What polygons add is in plane/polygon_manifold.hpp.
#pragma once

#include <cstdint>

#include "granular_adapter/nscd/problem/bodies.hpp"
#include "granular_adapter/nscd/problem/walls.hpp"

namespace turbidite::nscd {

class PlacedPolygons;

struct ContactPoint {
    std::int32_t a = -1;       ///< body with the smaller id, -1: a wall
    std::int32_t b = -1;       ///< body
    std::int32_t wall = -1;    ///< index of the wall if a is -1
    std::int32_t feature = 0;  ///< which of several points of the pair
    double gap = 0.0;          ///< g(q), negative: overlap [m]
    Vec3 normal{};             ///< unit
    Vec3 arm_a{};              ///< centre of a to the contact point [m]
    Vec3 arm_b{};
    double length = 0.0;  ///< of the face that the point stands for; 0 for points [m]
    /// The normal stands on a side of a or of the wall (1), or of b (2), and turns with it; 0: on
    /// none, as between discs and between corners.
    std::int32_t turns_with = 0;
};

/// Two bodies; `offset` is b - a by the nearest image.
struct PairView {
    const Bodies& bodies;
    std::int32_t a;
    std::int32_t b;
    Vec3 offset;
    double alert;                              ///< only gaps below this are reported [m]
    const PlacedPolygons* polygons = nullptr;  ///< needed where a shape has corners
};

/// A body and a wall.
struct WallView {
    const Bodies& bodies;
    std::int32_t body;
    const Wall& wall;
    std::int32_t wall_index;
    double alert;
    const PlacedPolygons* polygons = nullptr;
};

}  // namespace turbidite::nscd
