// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Prescribed motions of the sides of the box and of walls inside it, from the resolved case
// (written by launcher/case/wall_motion), for grains and fluid alike:
//
//     run.wall_motions     `WALL KIND NUMBERS...` in run units, separated by `;`
//     run.inflow_motions   the same for the fluid that enters through sides `inflow`
//
// A motion is a displacement d(t) and an angle a(t) about the wall's pivot, both zero at t = 0:
//
//     constant   d = v t                                             a = w t
//     harmonic   d = A (sin(2 pi t/T + phase) - sin(phase))          a likewise
//     table      linear between its entries; constant after the last
//
// In a window a wall has the mean velocity of its motion, (d(t + dt) - d(t))/dt, so that it is at
// its prescribed position at the end of every window, and so has the fluid at this wall. Valid
// C++17.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "coupler/protocol/records.hpp"
#include "coupler/protocol/settings.hpp"

namespace turbidite {

/// Displacement of a moving wall since t = 0, or its rate.
struct WallShift {
    Vec3 displacement{};  ///< [m]
    double angle = 0.0;   ///< counter-clockwise [rad]
};

class WallMotion {
 public:
    virtual ~WallMotion() = default;
    virtual WallShift at(double time) const = 0;

    /// Mean velocity and spin of the window [time, time + step].
    virtual WallShift rate(double time, double step) const;
};

/// A motion and the key of its wall: 0 left, 1 right, 2 bottom, 3 top, then the walls inside the
/// box.
struct MovedWall {
    std::int32_t wall = 0;
    std::shared_ptr<const WallMotion> motion;
};

/// The motions under a key; none if it is missing or empty. Throws std::invalid_argument if the
/// text has another format.
std::vector<MovedWall> moved_walls(const Settings& settings, const char* key = "run.wall_motions");

}  // namespace turbidite
