// SPDX-License-Identifier: LGPL-2.1-or-later
//
// How long a run takes and how much memory, before it starts. The constants were fitted to runs of
// the shipped cases and studies, two at a time on two cores; docs/cluster.md says how well they
// hold.
#pragma once

#include <string>

#include "launcher/case/case_file.hpp"

namespace turbidite {

/// Wall time of one window [s], by what it goes to, on a core per rank.
struct WindowForecast {
    double fluid = 0.0;
    double grains = 0.0;
    double coupler = 0.0;   ///< routing, checks, balances
    double messages = 0.0;  ///< handing over from program to program
    bool side_by_side = false;

    /// The longer of fluid and grains where they work side by side (`split`), otherwise their sum.
    double seconds() const;
};

WindowForecast forecast_window(const ResolvedCase& resolved);

/// Wall time of the whole run [s], with its start.
double predicted_seconds(const ResolvedCase& resolved);

/// Resident memory of all programs of the run [GB = 1e9 bytes].
double predicted_memory(const ResolvedCase& resolved);

/// "40 s", "12 min", "3 h", "2 days"
std::string rough_time(double seconds);

}  // namespace turbidite
