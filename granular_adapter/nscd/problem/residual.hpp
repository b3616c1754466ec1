// SPDX-License-Identifier: LGPL-2.1-or-later
//
// How far impulses are from solving the contact problem: the same measures for all solvers.
//
//     natural map = sqrt( sum |r - P_K(r - rho (u + (mu |u_t|, 0)))|^2 / sum |r|^2 ),  rho = 1/W_nn
//
// is zero at a solution and nowhere else. It is dimensionless: the relative error of the impulses.
// The denominator has a lower bound set by the rounding of the velocities, so that grains falling
// side by side count as solved.
//
// Quad and max, the customary criteria of contact dynamics, measure the change that one more update
// of every contact, each on its own, would cause. With R the mean of old and new impulse and du =
// W_kk (new - old),
//
//     quad = sqrt(mean |du|^2) / sqrt(mean |W_kk R|^2),      max = max |du| / sqrt(mean |W_kk R|^2)
//
// A packing that converges slowly satisfies both far from the solution: they are for comparison
// only.
//
// The contact violation tells how far other velocities v, such as those that a fluid has corrected,
// are from the Signorini condition with these impulses, as the velocity
//
//     max |min(u_n, W_nn r_n)|,    u = H^T v + b
//
// which for a loaded contact is |u_n| and for any other what closes it too fast, -u_n. With a film
// (film.hpp) it is |W_nn (r_n* - r_n)|, r_n* the impulse of the contact alone: without one the
// same.
//
// With rolling resistance the natural map projects n, t and roll on |r_t| <= mu r_n, |m| <= rho r_n
// (plane/rolling_contact.hpp, space/turning_contact.hpp). Moments are divided, and spins
// multiplied, by sqrt(W_nn/W_rr).
//
// For callers that have the operator of the problem: measures.hpp.
#pragma once

#include "granular_adapter/nscd/problem/contact_problem.hpp"

namespace turbidite::nscd {

/// Residual of the natural map, >= 0; zero for a problem without contacts.
double natural_map_residual(const ContactProblem& problem, const Impulses& r);

/// How far v is from the Signorini condition with the impulses r [m/s].
double contact_violation(const ContactProblem& problem, const Impulses& r,
                         const std::vector<Twist>& v);

/// How far a body sinks in by what is left of a contact in a step of length dt, over the radius of
/// the smaller body: the largest dt times contact_violation over it. `radius`: of each body [m].
double largest_sinking(const ContactProblem& problem, const Impulses& r,
                       const std::vector<Twist>& v, const std::vector<double>& radius, double dt);

/// r without the parts that films carry: what presses on surfaces, which friction sees. Of an exact
/// update of each contact alone, so that the normal part and those that it limits belong together:
/// that of r, less the film's at these velocities, differs by the tolerance of the solver, and a
/// contact that slides would be inside its cone as often as beyond. By every rank, if one has
/// films. `v`: body_velocities(problem, r) [N s].
Impulses carried_by_contacts(const ContactProblem& problem, const Impulses& r,
                             const std::vector<Twist>& v);

/// The part of sum |r|^2 due to rounding alone [(N s)^2].
double rounding_floor(const ContactProblem& problem);

/// The same, contact by contact, for a caller that loops over the contacts anyway. Keeps no
/// reference.
class RoundingFloor {
 public:
    explicit RoundingFloor(const ContactProblem& problem);

    /// Of a contact whose diagonal block has the entry W_nn [(N s)^2].
    double term(const Contact& contact, double nn) const;

 private:
    std::vector<double> speeds_;  ///< free speed of each body [m/s]
    double cancelled_;
};

/// Quad and max.
struct ChangeMeasures {
    double quad = 0.0;
    double max = 0.0;
};
ChangeMeasures change_measures(const ContactProblem& problem, const Impulses& r);

/// The residual of the natural map, quad and max.
struct Measures {
    double residual = 0.0;
    ChangeMeasures change;
};

}  // namespace turbidite::nscd
