// SPDX-License-Identifier: LGPL-2.1-or-later
//
// `central-path`, an interior-point method for tight tolerances. It begins with sweeps of `nlgs`,
// which reduce the easy part of the error fastest. Then it follows the central path
// (path_system.hpp, central_path.hpp), which leads to a solution from far away, where sweeps and
// Newton methods cycle. The last digits are obtained by sweeps again: close to the middle of the
// solution set a few dozen are enough.
//
// A path may have very many turning points or end in rounding. Then the next one starts from
// another point; when all starting points have been tried, longer paths are allowed.
#pragma once

#include "granular_adapter/nscd/solvers/solver.hpp"

namespace turbidite::nscd {

class CentralPathSolver final : public ContactSolver {
 public:
    /// The iterations reported are sweeps of `nlgs` plus factorisations.
    SolverResult solve(const ContactProblem& problem, const Impulses& guess,
                       const SolverSettings& settings) const override;
};

}  // namespace turbidite::nscd
