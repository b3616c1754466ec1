// SPDX-License-Identifier: LGPL-2.1-or-later
//
// How far surfaces may approach each other while bodies and walls move with given velocities.
#pragma once

#include <vector>

#include "granular_adapter/nscd/problem/bodies.hpp"
#include "granular_adapter/nscd/problem/walls.hpp"

namespace turbidite::nscd {

/// An upper bound for any two bodies, and any body and wall, over a step [m]. Circles do not come
/// closer by turning; `corners` says that some bodies are none.
double approach_bound(const Bodies& bodies, const std::vector<Wall>& walls,
                      const std::vector<Twist>& twists, bool corners, double step);

}  // namespace turbidite::nscd
