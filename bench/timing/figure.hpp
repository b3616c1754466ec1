// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A benchmark is a list of figures. Each figure has a name that others may rely on, a target (the
// value aimed for), and a function that measures it. Missing the target is not a failure.
#pragma once

#include <string>
#include <vector>

namespace turbidite::bench {

class Site;

struct Reach {
    enum class Kind { at_least, at_most, none };
    Kind kind = Kind::none;
    double bound = 0.0;

    bool met(double value) const;
    std::string text() const;  ///< ">= 12"; empty for none
};

struct Measured {
    double value = 0.0;
    double lowest = 0.0, highest = 0.0;  ///< over the repeats
    std::vector<std::string> notes;      ///< the components of the value, one line each
};

struct Figure {
    std::string name;
    std::string what;
    std::string unit;
    Reach reach;
    Measured (*measure)(Site& site);  ///< throws Failure with the reason if it cannot be measured
};

struct Benchmark {
    std::string name;
    std::string help;
    std::vector<Figure> figures;
};

/// All benchmarks.
const std::vector<Benchmark>& benchmark_list();

}  // namespace turbidite::bench
