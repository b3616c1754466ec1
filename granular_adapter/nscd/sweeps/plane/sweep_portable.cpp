// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The sweeps for any processor, and the selection of the instruction set at run time.
#include <stdexcept>

#include "granular_adapter/nscd/problem/plane/rolling_contact.hpp"
#include "granular_adapter/nscd/sweeps/plane/sweep_rows.hpp"

#if defined(__GNUC__) && !defined(__clang__)
// Vectors of four doubles are passed in two registers here; no function passes them to another
// library.
#pragma GCC diagnostic ignored "-Wpsabi"
#endif

namespace turbidite::nscd {
namespace portable {
#include "granular_adapter/nscd/sweeps/plane/sweep_kernel.hpp"
}  // namespace portable

Instructions best_instructions() {
    return available(Instructions::avx2) ? Instructions::avx2 : Instructions::portable;
}

template <class Rows>
Sweeps<Rows> sweeps(Instructions instructions) {
    if (!available(instructions))
        throw std::invalid_argument("contact sweeps: this processor has no AVX2");
    return instructions == Instructions::avx2 ? avx2_sweeps<Rows>() : portable::sweeps<Rows>();
}

template Sweeps<DiscRows<4>> sweeps(Instructions);
template Sweeps<DiscRows<1>> sweeps(Instructions);
template Sweeps<RollingDiscRows<4>> sweeps(Instructions);
template Sweeps<RollingDiscRows<1>> sweeps(Instructions);
template Sweeps<GeneralRows<4>> sweeps(Instructions);
template Sweeps<GeneralRows<1>> sweeps(Instructions);
template Sweeps<GeneralRollingRows<1>> sweeps(Instructions);

}  // namespace turbidite::nscd
