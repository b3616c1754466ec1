// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The error in the gaps of rotating bodies with corners. A step keeps g + dt u_n >= 0 with the
// normals and arms at its start. Bodies rotate by dt omega meanwhile, and the gap at the end of the
// step is
//
//     g' = n' . D' ,   n' = R_O n ,   D' = g n + dt (v_I - v_O) + (R_I - 1) s_I - (R_O - 1) s_O
//
// where O is the body (or wall) to whose side the normal is fixed, I the other, s their arms to the
// two surface points of the contact, and R rotations by dt omega. The shortfall g + dt u_n - g' is
// of second order in the angle. If the step is solved again with the gaps reduced by it, it ends
// without the overlap it would have caused. Discs need no correction: their shortfall is never
// positive.
#pragma once

#include <vector>

#include "granular_adapter/nscd/detection/contact_point.hpp"
#include "granular_adapter/nscd/detection/narrow_phase.hpp"
#include "granular_adapter/nscd/problem/contact_problem.hpp"

namespace turbidite::nscd {

/// One step and its solution.
struct SolvedStep {
    const std::vector<ContactPoint>& points;
    const std::vector<Contact>& contacts;  ///< of the same points
    const Bodies& bodies;                  ///< at the start of the step
    const std::vector<Wall>& walls;
    const std::vector<Twist>& velocities;  ///< the solution
    double dt = 0.0;
};

/// g + dt u_n - g' of every contact; zero where the normal is fixed to no side [m].
std::vector<double> gap_shortfalls(const SolvedStep& step, const NarrowPhase& shapes);

}  // namespace turbidite::nscd
