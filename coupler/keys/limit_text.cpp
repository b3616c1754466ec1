// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/keys/limit_text.hpp"

#include <fmt/format.h>

#include <cmath>

namespace turbidite {
namespace {

/// Limits that are computed are off by their round-off: 2/36 times 36 is 2 all the same.
constexpr double round_off = 1e-12;

/// As a whole number of its last place, which `whole` makes of it.
template <class Whole>
std::string text_of(double limit, int digits, Whole whole) {
    if (limit == 0.0 || !std::isfinite(limit)) return fmt::format("{}", limit);
    const double place = std::pow(10.0, std::floor(std::log10(std::abs(limit))) + 1.0 - digits);
    const double multiple = limit / place;
    return fmt::format("{:.{}g}", whole(multiple, round_off * std::abs(multiple)) * place, digits);
}

}  // namespace

std::string at_most_text(double limit, int digits) {
    return text_of(limit, digits, [](double x, double slack) { return std::floor(x + slack); });
}

std::string at_least_text(double limit, int digits) {
    return text_of(limit, digits, [](double x, double slack) { return std::ceil(x - slack); });
}

}  // namespace turbidite
