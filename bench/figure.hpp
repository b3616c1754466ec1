// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What a benchmark measures. A benchmark is a list of figures; each has a name that others may rely
// on, a reach (what was hoped for), and a function that measures it. Out of reach is no failure.
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
    std::vector<std::string> notes;      ///< what the value is made of, one line each
};

struct Figure {
    std::string name;
    std::string what;
    std::string unit;
    Reach reach;
    Measured (*measure)(Site& site);  ///< throws Failure with the reason when it cannot be measured
};

struct Benchmark {
    std::string name;
    std::string help;
    std::vector<Figure> figures;
};

/// All there are.
const std::vector<Benchmark>& benchmark_list();

}  // namespace turbidite::bench
