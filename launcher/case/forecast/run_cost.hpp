// SPDX-License-Identifier: LGPL-2.1-or-later
//
// How long a run takes and how much memory, before it starts. The constants were fitted to runs of
// the shipped cases and studies, two at a time on two cores; docs/cluster.md says how well they
// hold.
#pragma once

#include <string>

#include "launcher/case/case_file.hpp"

namespace turbidite {

/// Wall time of one window [s], by what it goes to.
struct WindowForecast {
    double fluid = 0.0;
    double grains = 0.0;
    double coupler = 0.0;   ///< routing, checks, balances
    double messages = 0.0;  ///< handing over from program to program
    bool side_by_side = false;

    /// The longer of fluid and grains where they work side by side (`split`), otherwise their sum.
    double seconds() const;
};

/// Cores for the ranks of a job that is started here; as many as are asked for in a batch job of
/// several nodes, whose cores are not those of this machine.
double cores_for_a_job();

/// Those that a job on this host can use: of a batch job not more than its tasks.
double cores_here();

WindowForecast forecast_window(const ResolvedCase& resolved, double cores = cores_for_a_job());

/// A sentence where the fluid has more ranks than there are cores; otherwise empty.
std::string ranks_warning(const ResolvedCase& resolved, double cores = cores_for_a_job());

/// On how many ranks that contact engine moves so many spheres fastest.
std::int64_t best_grains_ranks(std::size_t spheres, double cores = cores_here());

/// A sentence where the grains are too few, or the cores, for several ranks of the contact engine.
std::string grains_ranks_warning(const ResolvedCase& resolved, double cores = cores_for_a_job());

/// Wall time of the whole run [s], with its start.
double predicted_seconds(const ResolvedCase& resolved);

/// Resident memory of all programs of the run [GB = 1e9 bytes].
double predicted_memory(const ResolvedCase& resolved);

/// "40 s", "12 min", "3 h", "2 days"
std::string rough_time(double seconds);

}  // namespace turbidite
