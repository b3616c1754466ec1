// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What makes the results of a run doubtful although it has not failed: for the terminal, run.json
// and the report.
#pragma once

#include <string>
#include <vector>

#include "coupler/output/measures/run_statistics.hpp"
#include "coupler/output/measures/solve_limits.hpp"

namespace turbidite {

struct RunWarning {
    std::string about;  ///< "solves", "courant"
    std::string text;   ///< a sentence with the remedy
};

std::vector<RunWarning> run_warnings(const RunStatistics& statistics, const SolveLimits& limits,
                                     const RunValues& run);

/// The Courant number of the window that has just been played is the first of the run above the
/// limit: a sentence; otherwise empty. `before` is the largest of the windows before it.
std::string first_large_courant(double before, const RunStatistics& statistics,
                                const RunValues& run);

}  // namespace turbidite
