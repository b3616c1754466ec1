// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/output/measures/courant_limit.hpp"

#include <fmt/format.h>

#include <cmath>

namespace turbidite {

double step_for_courant(double step, double courant) {
    // The Courant number is proportional to the step.
    const double wanted = step * largest_courant / courant;
    const double digit = std::pow(10.0, std::floor(std::log10(wanted)));
    return std::floor(wanted / digit) * digit;
}

std::string courant_advice(double step, double courant) {
    return fmt::format(
        "Above {:g} the motion depends on the time step and may be wrong, by whole diameters after "
        "a while. Use time.step = {:.3g} or less.",
        largest_courant, step_for_courant(step, courant));
}

}  // namespace turbidite
