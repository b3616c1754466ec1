// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Free velocities and mobilities of a contact problem from the fluid's responses for free grains,
// in the plane and in the order of the bodies.
#pragma once

#include <string>
#include <vector>

#include "coupler/protocol/records.hpp"
#include "granular_adapter/nscd/problem/bodies.hpp"
#include "granular_adapter/nscd/problem/plane/mobility.hpp"

namespace turbidite {

struct FreeMotion {
    std::vector<Twist> velocities;               ///< U^F, omega^F
    std::vector<nscd::PlanarTensor> mobilities;  ///< A^-1, A the effective inertia; 0: fixed
};

/// `when` ends the sentence of an error ("in window 3"). Throws std::runtime_error naming a grain
/// with no response or two, or one that is fixed in the host or in the fluid but not in both;
/// PhysicsRefused if an effective inertia is not positive definite.
FreeMotion free_motion(const nscd::Bodies& bodies, const std::vector<FreeResponse>& responses,
                       const std::string& when);

}  // namespace turbidite
