// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Walls. A half-space is solid behind its normal. All others are thin plates and shells with grains
// on both sides; a grain is held on the side on which its centre lies:
//
//     plane   a segment: flat, `half_length` finite
//     space   a rectangle, or a surface of revolution, whose meridian is a straight line: a
//             cylinder, a truncated cone, a plate with a round hole
//
// Walls are at rest or follow a prescribed motion,
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
#include "coupler/shapes/wall_surface.hpp"

namespace turbidite::nscd {

enum class WallForm {
    flat,       ///< a half-space, or in the plane a segment
    rectangle,  ///< 2 half_length along `side`, 2 half_width along normal x side
    round       ///< the meridian turned about the axis `normal` through `point`
};

struct Wall {
    Vec3 point{};                ///< on the wall, its middle if it has one; on the axis [m]
    Vec3 normal{0.0, 1.0, 0.0};  ///< inward, or the axis of a round wall; unit
    double friction = 0.0;       ///< mu of contacts with this wall, if it has no material
    /// Of a segment or rectangle; infinite for a half-space [m].
    double half_length = std::numeric_limits<double>::infinity();
    /// A plate or shell is all that is nearer to its line or surface than this [m].
    double half_thickness = 0.0;
    std::int32_t key = 0;  ///< identifies the wall in the contact memory; distinct per wall
    /// Index into the SurfaceTable; -1: the surface of the touching body, with `friction`.
    std::int32_t material = -1;
    Twist twist{};  ///< of the pivot, and about it
    Vec3 pivot{};   ///< [m]
    WallForm form = WallForm::flat;
    Vec3 side{};              ///< of a rectangle: unit, normal to `normal`
    double half_width = 0.0;  ///< of a rectangle [m]
    /// Ends of the meridian of a round wall; their circles are its rims.
    Meridian meridian{};
};

/// Whether it is anything but a half-space.
bool has_ends(const Wall& wall);

/// Of a wall with ends.
Extent extent_of(const Wall& wall);

/// The longest of its dimensions, for tolerances; of a wall with ends [m].
double size_of(const Wall& wall);

/// Whether a place is on the line or surface of a wall with ends, its edges included, to within a
/// distance [m].
bool is_on(const Wall& wall, const Vec3& place, double tolerance);

bool is_moving(const Wall& wall);

/// Velocity of the wall's material at a position [m/s].
Vec3 velocity_at(const Wall& wall, const Vec3& place);

/// Advances the wall by its prescribed motion over a step [s].
void move(Wall& wall, double step);

/// Distance of a point from the plane of a flat wall, positive on the side of the normal [m].
double signed_distance(const Wall& wall, const Vec3& point);

/// Throws std::invalid_argument unless the normal is a unit vector, friction is >= 0, lengths are
/// positive, and the motion is finite.
void check_wall(const Wall& wall);

}  // namespace turbidite::nscd
