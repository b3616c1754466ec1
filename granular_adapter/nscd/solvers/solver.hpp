// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Interface of all contact solvers. A solver changes nothing but its iterate. Failure to converge
// is a result, not an exception: the caller decides, and reports it.
#pragma once

#include <cstdint>
#include <limits>

#include "granular_adapter/nscd/problem/contact_problem.hpp"
#include "granular_adapter/nscd/problem/residual.hpp"

namespace turbidite::nscd {

struct SolverSettings {
    /// Of the scaled natural map (residual.hpp). Usually 1e-3; 1e-2 gives a preview; below 1e-4
    /// dense lattices need thousands of sweeps.
    double tolerance = 1e-3;
    /// Upper limit of sweeps. With too few, rigid packings behave elastically; the result therefore
    /// says if they were not enough.
    std::int64_t max_iterations = 2000;
    /// Sweeps between two evaluations of the residual; fewer waste time on evaluations, more on
    /// sweeps.
    std::int64_t check_interval = 8;
    /// Sweeps after which those that follow may have momentum (sweeps/momentum.hpp); without it
    /// unless somebody asks.
    std::int64_t momentum_after = std::numeric_limits<std::int64_t>::max();
    /// Threads for this solve; the result does not depend on it. Small problems use one
    /// (nlgs_iteration.hpp).
    std::int64_t threads = 1;
};

struct SolverResult {
    Impulses impulses;
    std::vector<Twist> velocities;  ///< v_free + M^-1 H r for these impulses, to rounding
    std::int64_t iterations = 0;
    double residual = 0.0;  ///< natural_map_residual of these impulses
    ChangeMeasures change;  ///< quad and max of these impulses (residual.hpp)
    bool converged = true;
};

class ContactSolver {
 public:
    virtual ~ContactSolver() = default;

    /// `guess`: one entry per contact.
    virtual SolverResult solve(const ContactProblem& problem, const Impulses& guess,
                               const SolverSettings& settings) const = 0;

    /// Whether it solves problems of space besides those of the plane.
    virtual bool solves_space() const { return false; }

    /// Whether it solves problems with films of liquid.
    virtual bool solves_films() const { return false; }

    /// Whether it solves problems that several ranks share.
    virtual bool solves_on_ranks() const { return false; }
};

}  // namespace turbidite::nscd
