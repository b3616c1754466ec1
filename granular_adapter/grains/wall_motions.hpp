// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Prescribed motions of walls that are not constant, from the resolved case (`run.wall_motions`,
// written by launcher/case/wall_motion). A motion is a displacement d(t) and an angle a(t) about
// the wall's pivot, both zero at t = 0:
//
//     constant   d = v t                                             a = w t
//     harmonic   d = A (sin(2 pi t/T + phase) - sin(phase))          a likewise
//     table      linear between its entries; constant after the last
//
// In the contact problem of a window a wall has the mean velocity of its motion, (d(t + dt) -
// d(t))/dt, so that it is at its prescribed position at the end of every window.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "coupler/protocol/settings.hpp"
#include "granular_adapter/grains/borders.hpp"
#include "granular_adapter/nscd/problem/walls.hpp"

namespace turbidite {

/// Displacement of a moving wall since t = 0.
struct WallShift {
    Vec3 displacement{};  ///< [m]
    double angle = 0.0;   ///< counter-clockwise [rad]
};

class WallMotion {
 public:
    virtual ~WallMotion() = default;
    virtual WallShift at(double time) const = 0;
};

/// A motion and the key of its wall: 0 left, 1 right, 2 bottom, 3 top, then the walls inside the
/// box.
struct MovedWall {
    std::int32_t wall = 0;
    std::shared_ptr<const WallMotion> motion;
};

/// The motions of `run.wall_motions`; none if it is missing or empty. Throws std::invalid_argument
/// if the text has another format.
std::vector<MovedWall> moved_walls(const Settings& settings);

/// Sets the velocities that move the walls through a window.
void set_velocities(std::vector<nscd::Wall>& walls, const std::vector<MovedWall>& moved,
                    double time, double step);

/// Moves the borders to their walls.
void follow_walls(std::vector<Border>& borders, const std::vector<nscd::Wall>& walls);

}  // namespace turbidite
