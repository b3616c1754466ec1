// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/output/run_warnings.hpp"

#include <fmt/format.h>

#include "coupler/output/measures/courant_limit.hpp"

namespace turbidite {
namespace {

double courant_of(const RunStatistics& statistics) {
    return statistics.maxima.fluid ? statistics.maxima.fluid->courant : 0.0;
}

std::string advice(double courant, const RunValues& run) {
    return courant_advice(run.step / run.time, courant);
}

}  // namespace

std::vector<RunWarning> run_warnings(const RunStatistics& statistics, const SolveLimits& limits,
                                     const RunValues& run) {
    std::vector<RunWarning> warnings;
    for (std::string& sentence : unconverged_sentences(statistics, limits))
        warnings.push_back({"solves", std::move(sentence)});
    if (const double courant = courant_of(statistics); courant > largest_courant)
        warnings.push_back({"courant", fmt::format("the Courant number was up to {:.2g}. {}",
                                                   courant, advice(courant, run))});
    return warnings;
}

std::string first_large_courant(double before, const RunStatistics& statistics,
                                const RunValues& run) {
    const double now = courant_of(statistics);
    // Only in the window in which the largest number crosses the limit.
    if (before > largest_courant || !(now > largest_courant)) return "";
    return fmt::format("the Courant number is {:.2g} in window {}. {}", now,
                       statistics.windows_done - 1, advice(now, run));
}

}  // namespace turbidite
