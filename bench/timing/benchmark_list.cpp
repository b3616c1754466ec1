// SPDX-License-Identifier: LGPL-2.1-or-later
#include <fmt/format.h>

#include "bench/contact/contact_figures.hpp"
#include "bench/coupling/coupling_figures.hpp"
#include "bench/fluid/fluid_figures.hpp"
#include "bench/fluid/space_figures.hpp"
#include "bench/fluid/splitting_figures.hpp"
#include "bench/timing/figure.hpp"

namespace turbidite::bench {

bool Reach::met(double value) const {
    switch (kind) {
        case Kind::at_least:
            return value >= bound;
        case Kind::at_most:
            return value <= bound;
        case Kind::none:
            break;
    }
    return true;
}

std::string Reach::text() const {
    if (kind == Kind::none) return "";
    return fmt::format("{} {:g}", kind == Kind::at_least ? ">=" : "<=", bound);
}

namespace {

std::vector<Figure> joined(std::vector<Figure> all, const std::vector<Figure>& more) {
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

}  // namespace

const std::vector<Benchmark>& benchmark_list() {
    static const std::vector<Benchmark> list = {
        {"fluid",
         "one core, two ranks and the memory of the fluid step, plane and space; splittings",
         joined(joined(fluid_figures(), splitting_figures()), space_figures())},
        {"contact",
         "contact-iterations per second, growth with size, comparison with other solvers",
         contact_figures()},
        {"coupling",
         "what the coupler adds to a window, what waiting costs, growth with grains and ranks",
         coupling_figures()},
    };
    return list;
}

}  // namespace turbidite::bench
