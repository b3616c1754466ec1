// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What contacts of turning polygons miss. A step keeps g + dt u_n >= 0 with normals and arms as
// they are at its start; while bodies turn by dt omega, the gap at its end is
//
//     g' = n' . D' ,   n' = R_O n ,   D' = g n + dt (v_I - v_O) + (R_I - 1) s_I - (R_O - 1) s_O
//
// where O is the body (or wall) on whose side the normal stands, I the other, s their arms to the
// contact's two surface points and R rotations by dt omega. The shortfall g + dt u_n - g' is of
// second order in the turn. Solved again with the gaps taken smaller by it, the step ends without
// the overlap that it would have made. Discs have none: theirs is never positive.
#pragma once

#include <vector>

#include "granular_adapter/nscd/detection/contact_point.hpp"
#include "granular_adapter/nscd/detection/plane/placed_polygons.hpp"
#include "granular_adapter/nscd/problem/contact_problem.hpp"

namespace turbidite::nscd {

/// One step, as it was solved.
struct SolvedStep {
    const std::vector<ContactPoint>& points;
    const std::vector<Contact>& contacts;  ///< of the same points
    const Bodies& bodies;                  ///< at the start of the step
    const std::vector<Wall>& walls;
    const std::vector<Twist>& velocities;  ///< found
    double dt = 0.0;
};

/// g + dt u_n - g' of every contact; zero where no side turns with the normal [m].
std::vector<double> gap_shortfalls(const SolvedStep& step, const PolygonShapes& shapes);

}  // namespace turbidite::nscd
