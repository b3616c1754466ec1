// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Non-linear Gauss-Seidel in body-velocity form: contact by contact in the order given,
//
//     u = H_k^T v + b_k,   r_k' = exact solution of the contact alone,   v += M^-1 H_k (r_k' - r_k)
//
// until the scaled natural map falls below the tolerance. Every few sweeps the natural map is
// accumulated in the pass itself, where velocities are half old and half new; when that looks good
// the published residual, of one consistent state, decides.
//
// Contacts that have no impulse and do not close rest: they are in groups of their own, which
// sweeps leave out until a measuring sweep, which asks all of them, finds one that closes.
//
// How it is done fast, with the same bits: contact_schedule.hpp, sweep_kernel.hpp,
// sweep_pipeline.hpp.
#pragma once

#include "granular_adapter/nscd/solvers/solver.hpp"
#include "granular_adapter/nscd/sweeps/plane/sweep_rows.hpp"

namespace turbidite::nscd {

class Nlgs final : public ContactSolver {
 public:
    explicit Nlgs(Instructions instructions = best_instructions()) : instructions_(instructions) {}

    SolverResult solve(const ContactProblem& problem, const Impulses& guess,
                       const SolverSettings& settings) const override;

 private:
    Instructions instructions_;
};

}  // namespace turbidite::nscd
