// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Straight walls: half-planes, solid behind the normal, or segments (`half_length` finite), which
// are thin plates with grains on both sides: the side on which a grain's centre is holds it. They
// rest or follow a prescribed motion,
//
//     v(x) = velocity + spin e_z x (x - pivot)
//
// and a moving wall drags and pushes what touches it without feeling it. A belt is a wall that
// moves along itself.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "coupler/protocol/records.hpp"

namespace turbidite::nscd {

struct Wall {
    Vec3 point{};                ///< on the wall; the middle of a segment [m]
    Vec3 normal{0.0, 1.0, 0.0};  ///< inward, unit
    double friction = 0.0;       ///< mu of contacts with this wall, where it has no material
    double half_length = std::numeric_limits<double>::infinity();  ///< of a segment [m]
    std::int32_t key = 0;  ///< names the wall in the contact memory; distinct per wall
    /// Index into the SurfaceTable; -1: the surface of the body that touches, with `friction`.
    std::int32_t material = -1;
    Vec3 velocity{};    ///< of the pivot [m/s]
    double spin = 0.0;  ///< about the pivot [rad/s]
    Vec3 pivot{};       ///< moves with `velocity` [m]
};

bool is_moving(const Wall& wall);

/// Of the wall's material at a place [m/s].
Vec3 velocity_at(const Wall& wall, const Vec3& place);

/// Follows the prescribed motion over a step.
void move(Wall& wall, double step);

/// Distance of a point from the wall's line, positive on the grains' side [m].
double signed_distance(const Wall& wall, const Vec3& point);

/// Coordinate of a point along the wall, zero at `wall.point` [m].
double along(const Wall& wall, const Vec3& point);

/// Throws std::invalid_argument unless the normal is a unit vector, friction is >= 0, the half
/// length is positive and the motion finite and in the plane.
void check_wall(const Wall& wall);

}  // namespace turbidite::nscd
