// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Limits of the solves of a window, and warnings about solves that stopped at them.
#pragma once

#include <string>
#include <vector>

#include "coupler/output/measures/run_statistics.hpp"
#include "coupler/protocol/settings.hpp"

namespace turbidite {

struct SolveLimit {
    std::int64_t iterations = 0;
    double tolerance = 0.0;
};

struct SolveLimits {
    bool users_program = false;  ///< moves the grains, about which no key is known
    SolveLimit contact;          ///< contact.iterations, contact.tolerance (natural map, scaled)
    SolveLimit splitting;        ///< fluid.splitting_iterations, fluid.splitting_tolerance [u_c/D]
    bool corrects_once = false;  ///< explicit-multiplier, which has no such tolerance
    SolveLimit multipliers;      ///< fluid.multiplier_iterations, fluid.multiplier_tolerance [u_c]
    SolveLimit joint;            ///< coupling.iterations, coupling.tolerance [u_c]
    double slip = 0.0;           ///< run.slip_tolerance [u_c]
};

/// Limits whose keys the case does not have stay 0: their solves do not occur in it.
SolveLimits solve_limits(const Settings& settings);

/// Warnings about solves that stopped at their limits, one sentence each with the keys to change;
/// empty if all converged.
std::vector<std::string> unconverged_sentences(const RunStatistics& statistics,
                                               const SolveLimits& limits);

}  // namespace turbidite
