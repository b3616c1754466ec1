// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Measures figures one after the other, prints each as soon as it is available, and then the table.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/timing/figure.hpp"

namespace turbidite::bench {

struct BenchOrder {
    std::vector<std::string> benchmarks;  ///< names; empty: all
    std::vector<std::string> figures;     ///< names; empty: all of the benchmarks
    std::filesystem::path json;           ///< empty: none
    bool quick = false;
};

/// False if a figure could not be measured; the other figures are reported, and the reason is in
/// the table and in the file. Throws Failure (bad_input) for unknown names.
///
/// The file maps names of figures to {value, unit, command, reach, reached, lowest, highest,
/// notes}; a figure that could not be measured has a null value and a reason.
bool run_benchmarks(const BenchOrder& order);

/// Names and meanings of all benchmarks and figures.
std::string benchmark_overview();

}  // namespace turbidite::bench
