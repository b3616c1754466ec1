// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Non-linear Gauss-Seidel (NLGS) in body velocities. For each contact, in the given order,
//
//     u = H_k^T v + b_k,   r_k' = exact solution of the contact alone,   v += M^-1 H_k (r_k' - r_k)
//
// until the scaled natural map falls below the tolerance. Every few sweeps the natural map is
// summed during the sweep itself, where part of the velocities is old and part new. If this sum is
// small enough, the reported residual is computed from one consistent state, and decides.
//
// A contact is inactive while it has no impulse and does not close. Inactive contacts are in groups
// of their own, which sweeps skip; the measuring sweeps test them all and reactivate groups with a
// closing contact.
//
// Where a caller asks for it, later sweeps have momentum (momentum_phases.hpp).
//
// The fast implementation, with bitwise the same result: nlgs_iteration.hpp, contact_schedule.hpp,
// sweep_pipeline.hpp, and the kernel of each kind of contact (plane/sweep_kernel.hpp,
// space/sphere_kernel.hpp).
#pragma once

#include "granular_adapter/nscd/solvers/solver.hpp"
#include "granular_adapter/nscd/sweeps/instructions.hpp"

namespace turbidite::nscd {

class Nlgs final : public ContactSolver {
 public:
    explicit Nlgs(Instructions instructions = best_instructions()) : instructions_(instructions) {}

    SolverResult solve(const ContactProblem& problem, const Impulses& guess,
                       const SolverSettings& settings) const override;

    bool solves_space() const override { return true; }
    bool solves_films() const override { return true; }
    bool solves_on_ranks() const override { return true; }

 private:
    Instructions instructions_;
};

}  // namespace turbidite::nscd
