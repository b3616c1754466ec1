// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Non-linear Gauss-Seidel on the assembled Delassus operator: contact by contact in the order
// given,
//
//     b = u_free,k + sum_{j != k} W_kj r_j,   r_k = exact solution of the contact alone
//
// A contact reads its neighbours' impulses instead of two bodies: twice the work and more in dense
// packings of discs, but no body velocities that rounding could carry away over many sweeps. The
// reference for `nlgs` and for codes that know nothing but W.
#pragma once

#include "granular_adapter/nscd/solvers/solver.hpp"

namespace turbidite::nscd {

class NlgsStored final : public ContactSolver {
 public:
    /// Throws std::invalid_argument when a contact resists rolling.
    SolverResult solve(const ContactProblem& problem, const Impulses& guess,
                       const SolverSettings& settings) const override;
};

}  // namespace turbidite::nscd
