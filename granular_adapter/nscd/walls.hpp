// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Straight walls at rest: half-planes, or segments when `half_length` is finite. The normal points
// to where the grains are.
#pragma once

#include <cstdint>
#include <limits>

#include "coupler/protocol/records.hpp"

namespace turbidite::nscd {

struct Wall {
    Vec3 point{};                ///< on the wall; the middle of a segment [m]
    Vec3 normal{0.0, 1.0, 0.0};  ///< inward, unit
    double friction = 0.0;       ///< mu of contacts with this wall
    double half_length = std::numeric_limits<double>::infinity();  ///< of a segment [m]
    std::int32_t key = 0;  ///< names the wall in the contact memory; distinct per wall
};

/// Distance of a point from the wall's line, positive on the grains' side [m].
double signed_distance(const Wall& wall, const Vec3& point);

/// Coordinate of a point along the wall, zero at `wall.point` [m].
double along(const Wall& wall, const Vec3& point);

/// Throws std::invalid_argument unless the normal is a unit vector and friction is >= 0.
void check_wall(const Wall& wall);

}  // namespace turbidite::nscd
