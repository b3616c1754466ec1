// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Sweeps over packed groups of contacts (Rows), of any kind and for any instruction set.
#pragma once

#include <cstdint>
#include <stdexcept>

#include "granular_adapter/nscd/sweeps/instructions.hpp"

namespace turbidite::nscd {

/// One value for each contact of a group.
template <int width>
struct alignas(8 * width) Lanes {
    double v[width] = {};
};

/// Sums over the contacts of a sweep, lane by lane.
template <int width>
struct PassSums {
    Lanes<width> error;   ///< |natural map|^2
    Lanes<width> size;    ///< |r|^2
    Lanes<width> loaded;  ///< number of contacts with an impulse after their update
};

template <int width>
double total(const Lanes<width>& lanes) {
    double sum = 0.0;
    for (const double value : lanes.v) sum += value;
    return sum;
}

/// Updates every contact of the groups [begin, end). `measured` also adds the state of each contact
/// before its update to the sums. `asked` is for groups at rest: it updates only those in which a
/// contact has an impulse or closes, and reports in `awake` which groups have an impulse
/// afterwards.
template <class Rows>
struct Sweeps {
    using Body = typename Rows::Body;
    using Sums = PassSums<Rows::width>;
    void (*plain)(Rows* begin, Rows* end, Body* bodies) = nullptr;
    void (*measured)(Rows* begin, Rows* end, Body* bodies, Sums& sums) = nullptr;
    void (*asked)(Rows* begin, Rows* end, Body* bodies, Sums& sums, std::uint8_t* awake) = nullptr;
};

/// Instantiated by each kind for its rows with four lanes and, as the reference in tests, with one;
/// both give bitwise the same results.
template <class Rows>
Sweeps<Rows> portable_sweeps();
template <class Rows>
Sweeps<Rows> avx2_sweeps();

/// Throws std::invalid_argument if the processor lacks the instructions.
template <class Rows>
Sweeps<Rows> sweeps(Instructions instructions) {
    if (!available(instructions))
        throw std::invalid_argument("contact sweeps: this processor has no AVX2");
    return instructions == Instructions::avx2 ? avx2_sweeps<Rows>() : portable_sweeps<Rows>();
}

}  // namespace turbidite::nscd
