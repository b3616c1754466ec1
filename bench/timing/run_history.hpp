// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Runs of shipped cases that benchmarks play with `turbidite run`.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace turbidite::bench {

class Site;

/// Columns of a run's history.csv by name; empty cells become NaN.
using RunHistory = std::map<std::string, std::vector<double>>;

RunHistory read_history(const std::filesystem::path& run);

/// Plays a case of configs/ with changes key=value, as folder `name` of the site; returns the run
/// folder. Throws Failure if it does not end well.
std::filesystem::path play_case(Site& site, const std::string& the_case, const std::string& name,
                                const std::vector<std::string>& changes);

}  // namespace turbidite::bench
