// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Free velocities and mobilities of a contact problem from the fluid's responses for free grains,
// in the order of the bodies. In space the mobility is that of a sphere: of the effective inertia
// A it takes the means of the diagonals, tr(A_tt)/3 and tr(A_rr)/3. What A has beside these is
// small (5.5 % for one sphere, docs/decisions/multipliers.md), and response and push of the fluid
// use the same A, so that the rounds of `joint` end at the same motion.
#pragma once

#include <string>
#include <vector>

#include "coupler/protocol/records.hpp"
#include "granular_adapter/nscd/problem/bodies.hpp"
#include "granular_adapter/nscd/problem/mobilities.hpp"

namespace turbidite {

struct FreeMotion {
    std::vector<Twist> velocities;  ///< U^F, omega^F
    nscd::Mobilities mobilities;    ///< A^-1, A the effective inertia; 0: fixed
};

/// `when` ends the sentence of an error ("in window 3"). Throws std::runtime_error naming a grain
/// with no response or two, or one that is fixed in the host or in the fluid but not in both;
/// PhysicsRefused if an effective inertia is not positive definite.
FreeMotion free_motion(const nscd::Bodies& bodies, const std::vector<FreeResponse>& responses,
                       const std::string& when, int dimension);

}  // namespace turbidite
