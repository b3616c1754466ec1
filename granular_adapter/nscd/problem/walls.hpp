// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Flat walls: half-spaces, solid behind the normal, or in the plane segments (`half_length`
// finite). A segment is a thin plate with grains on both sides; a grain is held on the side on
// which its centre lies. Walls are at rest or follow a prescribed motion,
//
//     v(x) = velocity + spin x (x - pivot)
//
// and a moving wall drags and pushes what touches it, without any reaction on itself. A belt is a
// wall that moves along itself.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "coupler/rigid/rigid_motion.hpp"

namespace turbidite::nscd {

struct Wall {
    Vec3 point{};                ///< on the wall; the midpoint of a segment [m]
    Vec3 normal{0.0, 1.0, 0.0};  ///< inward, unit
    double friction = 0.0;       ///< mu of contacts with this wall, if it has no material
    /// Of a segment; infinite for a half-space [m].
    double half_length = std::numeric_limits<double>::infinity();
    /// A segment is all that is nearer to its line than this, with round ends [m].
    double half_thickness = 0.0;
    std::int32_t key = 0;  ///< identifies the wall in the contact memory; distinct per wall
    /// Index into the SurfaceTable; -1: the surface of the touching body, with `friction`.
    std::int32_t material = -1;
    Twist twist{};  ///< of the pivot, and about it
    Vec3 pivot{};   ///< [m]
};

bool is_moving(const Wall& wall);

/// Velocity of the wall's material at a position [m/s].
Vec3 velocity_at(const Wall& wall, const Vec3& place);

/// Advances the wall by its prescribed motion over a step [s].
void move(Wall& wall, double step);

/// Distance of a point from the surface of the wall, positive on the side of the normal [m].
double signed_distance(const Wall& wall, const Vec3& point);

/// Throws std::invalid_argument unless the normal is a unit vector, friction is >= 0, the half
/// length is positive, and the motion is finite.
void check_wall(const Wall& wall);

}  // namespace turbidite::nscd
