// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Where the solves of a window stop, and what a user is told when they stop there.
#pragma once

#include <string>
#include <vector>

#include "coupler/output/run_statistics.hpp"
#include "coupler/protocol/settings.hpp"

namespace turbidite {

struct SolveLimit {
    std::int64_t iterations = 0;
    double tolerance = 0.0;
};

struct SolveLimits {
    SolveLimit contact;      ///< contact.iterations, contact.tolerance (natural map, scaled)
    SolveLimit multipliers;  ///< fluid.multiplier_iterations, fluid.multiplier_tolerance [u_c]
    SolveLimit joint;        ///< coupling.iterations, coupling.tolerance [u_c]
    double slip = 0.0;       ///< run.slip_tolerance [u_c]
};

/// Limits whose keys the case does not have stay 0: their solves do not occur in it.
SolveLimits solve_limits(const Settings& settings);

/// What a user must know of solves that ended by their limits, a sentence each with the keys to
/// change; empty when all converged.
std::vector<std::string> unconverged_sentences(const RunStatistics& statistics,
                                               const SolveLimits& limits);

}  // namespace turbidite
