// SPDX-License-Identifier: LGPL-2.1-or-later
//
// How far impulses are from solving the contact problem: one measure for all solvers.
//
//     natural map = sqrt( sum |r - P_K(r - rho (u + (mu |u_t|, 0)))|^2 / sum |r|^2 ),  rho = 1/W_nn
//
// is zero at a solution and nowhere else. Dimensionless: the share of the impulses that is wrong.
// The denominator never falls below what rounding of the velocities leaves, so that grains which
// fall side by side count as solved.
//
// Quad and Max say how much one more update of every contact, each alone, would change (the
// customary criteria of contact dynamics): R mean of old and new impulse, du = W_kk (new - old),
//
//     quad = sqrt(mean |du|^2) / sqrt(mean |W_kk R|^2),      max = max |du| / the same
//
// A slowly converging packing passes those far from the solution: they are for comparison only.
//
// Where a contact resists rolling the natural map projects n, t and roll on |r_t| <= mu r_n, |m| <=
// rho r_n (rolling_contact.hpp). Moments are divided, spins multiplied, by sqrt(W_nn/W_rr).
#pragma once

#include "granular_adapter/nscd/problem/contact_problem.hpp"

namespace turbidite::nscd {

class Delassus;

double natural_map_residual(const ContactProblem& problem, const Impulses& r);

/// sum |r|^2 that rounding alone explains [(N s)^2].
double rounding_floor(const ContactProblem& problem);

struct ChangeMeasures {
    double quad = 0.0;
    double max = 0.0;
};
ChangeMeasures change_measures(const ContactProblem& problem, const Impulses& r);

/// The natural map's residual, and quad and max.
struct Measures {
    double residual = 0.0;
    ChangeMeasures change;
};

/// The same where the caller has the operator of this problem, v = body_velocities(problem, r), and
/// the floor at hand.
double rounding_floor(const ContactProblem& problem, const Delassus& w);
double natural_map_residual(const ContactProblem& problem, const Delassus& w,
                            const std::vector<Twist>& v, const Impulses& r, double floor);
Measures measures(const ContactProblem& problem, const Delassus& w, const std::vector<Twist>& v,
                  const Impulses& r, double floor);

}  // namespace turbidite::nscd
