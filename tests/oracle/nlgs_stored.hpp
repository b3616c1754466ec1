// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Non-linear Gauss-Seidel (NLGS) on the assembled Delassus operator, the reference for `nlgs`. For
// each contact, in the given order,
//
//     b = u_free,k + sum_{j != k} W_kj r_j,   r_k = exact solution of the contact alone
//
// A contact reads the impulses of its neighbours instead of two body velocities. In dense packings
// of discs this is more than twice the work, but there are no body velocities on which rounding
// could accumulate over many sweeps.
#pragma once

#include <vector>

#include "granular_adapter/nscd/problem/plane/one_contact.hpp"
#include "granular_adapter/nscd/solvers/solver_list.hpp"

namespace turbidite::nscd {

class NlgsStored final : public ContactSolver {
 public:
    /// Throws std::invalid_argument if a contact has rolling resistance.
    SolverResult solve(const ContactProblem& problem, const Impulses& guess,
                       const SolverSettings& settings) const override;
};

/// u = H^T v_free + b of every contact, (n, t) [m/s].
std::vector<Plane> free_contact_velocities(const ContactProblem& problem);

/// The solvers that a case may choose, and behind them `nlgs-stored`.
const std::vector<SolverEntry>& solvers_and_reference();

}  // namespace turbidite::nscd
