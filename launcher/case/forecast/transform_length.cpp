// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/forecast/transform_length.hpp"

#include <fmt/format.h>

#include <cmath>

#include "coupler/keys/key_spec.hpp"
#include "coupler/keys/key_value.hpp"

namespace turbidite {
namespace {

/// FFTW has code for factors up to 13: with 11 or 13 a transform takes at most 2.2 times as long
/// as with factors 2, 3 and 5 alone, with 53 about 4 and with 107 about 6 times (100 values).
constexpr int largest_quick_factor = 13;

}  // namespace

int largest_prime_factor(int n) {
    int largest = 1;
    for (int factor = 2; factor * factor <= n; ++factor)
        for (; n % factor == 0; n /= factor) largest = factor;
    return n > 1 ? n : largest;
}

int good_transform_length(int n) {
    while (largest_prime_factor(n) > 7) ++n;
    return n;
}

std::vector<std::string> slow_transforms(const Settings& settings) {
    const auto size = real_list("domain.size", settings.text("domain.size"));
    const double across = settings.real("fluid.cells_per_diameter");
    std::vector<std::string> slow;
    // x and, in space, z: systems along y are solved by elimination, for which any number will do.
    for (std::size_t axis = 0; axis < size.size(); axis += 2) {
        const int cells = static_cast<int>(std::lround(size[axis] * across));
        const int factor = largest_prime_factor(cells);
        if (factor <= largest_quick_factor) continue;
        const int good = good_transform_length(cells);
        slow.push_back(
            fmt::format("{} cells along {} have the prime factor {}, which makes the solves for "
                        "pressure and viscosity slower; {} D, {} cells, has small factors only",
                        cells, "xyz"[axis], factor, real_text(good / across), good));
    }
    return slow;
}

}  // namespace turbidite
