// SPDX-License-Identifier: LGPL-2.1-or-later
//
// How far two surfaces can approach each other while bodies and walls move with given velocities.
#pragma once

#include <vector>

#include "granular_adapter/nscd/problem/bodies.hpp"
#include "granular_adapter/nscd/problem/walls.hpp"

namespace turbidite::nscd {

/// Largest speed of a corner about the centre of its body; one twist per body [m/s].
double corner_speed(const Bodies& bodies, const std::vector<Twist>& twists);

/// An upper bound over all pairs of bodies, and of bodies and walls, for one step [m]. `twists`:
/// with the extremes of all velocities. Rotation does not bring round bodies closer; `corners`:
/// corner_speed() where some are not round.
double approach_bound(const Bodies& bodies, const std::vector<Wall>& walls,
                      const std::vector<Twist>& twists, double corners, double step);

}  // namespace turbidite::nscd
