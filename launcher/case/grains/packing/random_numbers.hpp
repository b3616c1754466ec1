// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Random numbers that are the same with every standard library: the standard fixes the 64-bit
// Mersenne twister but not the distributions of <random>, so the mapping is done here.
#pragma once

#include <cstdint>
#include <random>

namespace turbidite {

class RandomNumbers {
 public:
    explicit RandomNumbers(std::uint64_t seed) : engine_(seed) {}

    /// Uniform in [0, 1): the upper 53 bits.
    double uniform() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }

    double uniform(double lower, double upper) { return lower + (upper - lower) * uniform(); }

    /// Uniform in 0 … count - 1; the bias for count << 2^53 is far below 1e-9.
    std::int64_t index(std::int64_t count) {
        return static_cast<std::int64_t>(uniform() * static_cast<double>(count));
    }

 private:
    std::mt19937_64 engine_;
};

}  // namespace turbidite
