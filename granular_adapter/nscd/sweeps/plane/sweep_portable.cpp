// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The sweeps for any processor.
#include "granular_adapter/nscd/problem/plane/filmed_contact.hpp"
#include "granular_adapter/nscd/sweeps/plane/sweep_rows.hpp"

#if defined(__GNUC__) && !defined(__clang__)
// Vectors of four doubles are passed in two registers here; no function passes them to another
// library.
#pragma GCC diagnostic ignored "-Wpsabi"
#endif

namespace turbidite::nscd {
namespace portable {
#include "granular_adapter/nscd/sweeps/lane_kernel.hpp"
#include "granular_adapter/nscd/sweeps/plane/sweep_kernel.hpp"
#include "granular_adapter/nscd/sweeps/sweep_loops.hpp"
}  // namespace portable

template <class Rows>
Sweeps<Rows> portable_sweeps() {
    return portable::sweeps<Rows>();
}

template Sweeps<DiscRows<4>> portable_sweeps();
template Sweeps<DiscRows<1>> portable_sweeps();
template Sweeps<RollingDiscRows<4>> portable_sweeps();
template Sweeps<RollingDiscRows<1>> portable_sweeps();
template Sweeps<GeneralRows<4>> portable_sweeps();
template Sweeps<GeneralRows<1>> portable_sweeps();
template Sweeps<AnyRows<1>> portable_sweeps();

}  // namespace turbidite::nscd
