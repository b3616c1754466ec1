// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Walls and bodies of the contact problem that follow the prescribed motions of the case
// (coupler/protocol/scene/prescribed_motion.hpp).
#pragma once

#include <vector>

#include "coupler/protocol/scene/prescribed_motion.hpp"
#include "granular_adapter/grains/borders.hpp"
#include "granular_adapter/nscd/problem/bodies.hpp"
#include "granular_adapter/nscd/problem/walls.hpp"

namespace turbidite {

/// Sets the velocities that move the walls through a window.
void set_velocities(std::vector<nscd::Wall>& walls, const std::vector<Moved>& moved, double time,
                    double step);

/// The same for grains.
void set_velocities(nscd::Bodies& bodies, const std::vector<Moved>& moved, double time,
                    double step);

/// Moves the borders to their walls.
void follow_walls(std::vector<Border>& borders, const std::vector<nscd::Wall>& walls);

}  // namespace turbidite
