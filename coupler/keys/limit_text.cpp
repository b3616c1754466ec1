// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/keys/limit_text.hpp"

#include <fmt/format.h>

#include <cmath>

namespace turbidite {
namespace {

/// Limits that are computed are off by their round-off: 2/36 times 36 is 2 all the same.
constexpr double round_off = 1e-12;

double last_place(double limit, int digits) {
    return std::pow(10.0, std::floor(std::log10(std::abs(limit))) + 1.0 - digits);
}

std::string text_of(double multiple, double place, int digits) {
    return fmt::format("{:.{}g}", multiple * place, digits);
}

bool as_it_is(double limit) {
    return limit == 0.0 || !std::isfinite(limit);
}

}  // namespace

std::string at_most_text(double limit, int digits) {
    if (as_it_is(limit)) return fmt::format("{}", limit);
    const double place = last_place(limit, digits), multiple = limit / place;
    return text_of(std::floor(multiple + round_off * std::abs(multiple)), place, digits);
}

std::string at_least_text(double limit, int digits) {
    if (as_it_is(limit)) return fmt::format("{}", limit);
    const double place = last_place(limit, digits), multiple = limit / place;
    return text_of(std::ceil(multiple - round_off * std::abs(multiple)), place, digits);
}

}  // namespace turbidite
