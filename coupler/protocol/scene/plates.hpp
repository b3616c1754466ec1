// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// Walls inside the box in the plane: plates that are at rest or follow a prescribed motion, for
/// grains and fluid alike. Those of space: space_walls.hpp. From the resolved case (written by
/// launcher/case/inner_walls):
///
///     run.walls   `ID X1 Y1 X2 Y2 VX VY SPIN PX PY FRICTION THICKNESS` in run units, separated by
///     `;`
///
/// and run.wall_motions (prescribed_motion.hpp) for those that follow a motion. Valid C++17.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "coupler/protocol/scene/prescribed_motion.hpp"
#include "coupler/protocol/scene/sides.hpp"

namespace turbidite {

/// Key of the first plate; those before it are the sides of the box.
constexpr std::int32_t first_plate(int dimension) {
    return static_cast<std::int32_t>(side_count(dimension));
}

/// All that is nearer to a segment than half the thickness, at t = 0, and its motion.
struct Plate {
    std::int32_t key = 0;  ///< of the wall, after those of the sides of the box
    GrainId id = 0;        ///< in the case
    Vec3 from{}, to{};     ///< ends [m]
    Vec3 pivot{};          ///< moves with the displacement, and the plate turns about it [m]
    double friction = 0.0;
    double thickness = 0.0;                          ///< [m]
    std::shared_ptr<const PrescribedMotion> motion;  ///< never null
};

/// Where a plate is and how it moves.
struct PlacedPlate {
    Vec3 middle{};       ///< [m]
    double angle = 0.0;  ///< of the direction from end to end, counter-clockwise from x [rad]
    Twist twist{};       ///< of its middle
};

double length(const Plate& plate);  ///< [m]

/// At a time, with the mean velocities of the window that begins then, in which the pivot moves
/// and the plate turns at constant rates.
PlacedPlate place(const Plate& plate, double time, double step);

/// None if the setting is missing or empty. Throws std::invalid_argument if a text has another
/// format.
std::vector<Plate> plates_of(const Settings& settings);

}  // namespace turbidite
