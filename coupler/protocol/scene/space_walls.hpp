// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// Walls inside the box in space: plates and round shells with grains on both sides, which are at
/// rest or follow a prescribed motion. From the resolved case (written by
/// launcher/case/walls/space_walls):
///
///     run.walls   `ID KIND X Y Z AX AY AZ BX BY BZ R1 R2 THICKNESS VX VY VZ WX WY WZ PX PY PZ
///                 FRICTION MATERIAL` in run units, separated by `;`
///
///     plate       the rectangle with the corner (X, Y, Z) and the edges A and B
///     cylinder    around the axis from (X, Y, Z) to its sum with A, of radius R1
///     cone        the same, of radius R1 at its beginning and R2 at its end
///     ring        about the axis A through (X, Y, Z) and normal to it, from radius R1 to R2
///
/// MATERIAL is an index as of grains, or -1: then contacts have the coefficients of the grain and
/// FRICTION. Motions as of plates of the plane (plates.hpp). Valid C++17.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "coupler/protocol/scene/prescribed_motion.hpp"

namespace turbidite {

/// See the head of this file.
enum class SpaceWallKind { plate, cylinder, cone, ring };

/// The kinds by their names.
struct SpaceWallName {
    const char* name;
    SpaceWallKind kind;
};
/// All of them.
const std::vector<SpaceWallName>& space_wall_names();

/// Form and place, in one unit of length.
struct SpaceWallShape {
    SpaceWallKind kind = SpaceWallKind::plate;
    Vec3 place{};
    Vec3 a{}, b{};                       ///< edges or axis; b of a plate only
    double radius = 0.0, radius2 = 0.0;  ///< of round walls
};

/// A wall inside the box, at t = 0 [m], and its motion.
struct SpaceWall : SpaceWallShape {
    std::int32_t key = 0;    ///< of the wall, after those of the sides of the box
    GrainId id = 0;          ///< in the case
    double thickness = 0.0;  ///< [m]
    Vec3 pivot{};            ///< moves with the displacement, and the wall turns about it [m]
    double friction = 0.0;
    std::int32_t material = -1;
    std::shared_ptr<const PrescribedMotion> motion;  ///< never null
};

/// None if the setting is missing or empty. Throws std::invalid_argument if a text has another
/// format.
std::vector<SpaceWall> space_walls_of(const Settings& settings);

}  // namespace turbidite
