// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Runs one of our solvers until Siconos' error measure is met: the natural map with rho = 1 of the
// dimensionless problem, relative to the largest norm of q, r and u.
#pragma once

#include "granular_adapter/nscd/solvers/solver.hpp"

namespace turbidite::siconos {

/// `problem` is dimensionless (siconos_problem.hpp).
double error_measure(const nscd::ContactProblem& problem, const nscd::Impulses& impulses);

struct Stopped {
    nscd::Impulses impulses;
    std::int64_t iterations = 0;
    double error = 0.0;  ///< by the measure above
    bool converged = false;
};

/// Starts from zero impulses. The solver's own tolerance is tightened, each time continuing from
/// the last impulses, until the measure is met or `most_iterations` are used up.
Stopped solve_to_measure(const nscd::ContactSolver& solver, const nscd::ContactProblem& problem,
                         double tolerance, std::int64_t most_iterations);

}  // namespace turbidite::siconos
