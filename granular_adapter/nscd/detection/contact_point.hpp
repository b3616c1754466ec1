// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A contact point: where two bodies, or a body and a wall, touch or nearly touch; and the arguments
// of a detector.
//
// The normal points from a (or the wall) to b. Between bodies both arms end at the same point,
// half-way across the gap, so that an impulse and its reaction have no net moment; at a wall the
// arm ends on the surface of the body. What polygons add is in plane/polygon_manifold.hpp.
#pragma once

#include <cstdint>

#include "granular_adapter/nscd/problem/bodies.hpp"
#include "granular_adapter/nscd/problem/walls.hpp"

namespace turbidite::nscd {

struct PlacedShapes;

struct ContactPoint {
    std::int32_t a = -1;       ///< body with the smaller id; -1 for a wall
    std::int32_t b = -1;       ///< body
    std::int32_t wall = -1;    ///< index of the wall, if a is -1
    std::int32_t feature = 0;  ///< which of the pair's contact points
    double gap = 0.0;          ///< gap g(q), negative for an overlap [m]
    Vec3 normal{};             ///< unit
    Vec3 arm_a{};              ///< centre of a to the contact point [m]
    Vec3 arm_b{};
    double length = 0.0;  ///< of the face that the point represents; 0 for point contacts [m]
    /// The normal is fixed to a side of a or of the wall (1), or of b (2), and rotates with it; 0:
    /// to none, as between discs and between corners.
    std::int32_t turns_with = 0;
};

/// A sphere that just fits into a round wall touches it in further places than the nearest one,
/// each with features of its own.
inline constexpr std::int32_t features_of_a_place = 3;
/// Above the features of any shape: those of images of a wall across periodic sides.
inline constexpr std::int32_t features_per_image = 1 << 16;

/// Whether it is such a further point.
inline bool is_further_point(const Wall& wall, const ContactPoint& point) {
    return wall.form == WallForm::round &&
           point.feature % features_per_image >= features_of_a_place;
}

/// Two bodies; `offset` is b - a by the minimum image.
struct PairView {
    const Bodies& bodies;
    std::int32_t a;
    std::int32_t b;
    Vec3 offset;
    double alert;                          ///< only gaps below this are reported [m]
    const PlacedShapes* placed = nullptr;  ///< required if a shape has corners
};

/// A body and a wall.
struct WallView {
    const Bodies& bodies;
    std::int32_t body;
    const Wall& wall;
    std::int32_t wall_index;
    double alert;
    const PlacedShapes* placed = nullptr;
};

}  // namespace turbidite::nscd
