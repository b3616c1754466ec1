// SPDX-License-Identifier: LGPL-2.1-or-later
//
// An interior-point method for tight tolerances. Sweeps of `nlgs` come first, since they solve what
// is easy fastest. Then the central path (path_system.hpp, central_path.hpp), which leads to a
// solution from far away, where sweeps and Newton methods cycle. Its last digits are sweeps again:
// from near the middle of the solutions a few dozen are enough.
//
// A path may turn very often or end in rounding. Then the next one starts elsewhere, and when all
// starts have been tried, paths may be longer.
#pragma once

#include "granular_adapter/nscd/solvers/solver.hpp"

namespace turbidite::nscd {

class CentralPathSolver final : public ContactSolver {
 public:
    /// Counts sweeps of `nlgs` and factorisations together as iterations.
    SolverResult solve(const ContactProblem& problem, const Impulses& guess,
                       const SolverSettings& settings) const override;
};

}  // namespace turbidite::nscd
