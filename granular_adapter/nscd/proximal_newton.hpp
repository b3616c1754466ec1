// SPDX-License-Identifier: LGPL-2.1-or-later
//
// For tight tolerances. Sweeps of `nlgs` find out which contacts open, stick and slide; a Newton
// method with a sparse factorisation then finds the impulses to the last digit, in a few steps when
// the statuses are nearly right. Nobody knows beforehand when they are, so the two take turns:
//
//     200 sweeps, Newton steps; 400 sweeps, Newton steps; 800 …
//
// where the Newton steps may cost about as much as the sweeps before them. Each goes on from its
// own impulses, unless those of the sweeps are ten times better; who meets the tolerance first has
// solved the problem. The Newton steps solve proximal points around the impulses found so far
// (augmented_system.hpp), since W is singular in packings.
#pragma once

#include "granular_adapter/nscd/solver.hpp"

namespace turbidite::nscd {

class ProximalNewton final : public ContactSolver {
 public:
    /// Counts sweeps of `nlgs` and Newton steps together as iterations. Throws std::runtime_error
    /// when a factorisation fails, which only numbers that are none can cause.
    SolverResult solve(const ContactProblem& problem, const Impulses& guess,
                       const SolverSettings& settings) const override;
};

}  // namespace turbidite::nscd
