// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The sweeps for AVX2. Only the code of the kernels is compiled for it; everything included
// before stays portable, since its inline functions may be used in any other part of a program.
#include <stdexcept>

#include "granular_adapter/nscd/problem/plane/filmed_contact.hpp"
#include "granular_adapter/nscd/sweeps/plane/sweep_rows.hpp"

#ifdef TURBIDITE_AVX2

#pragma GCC push_options
#pragma GCC target("avx2")
namespace turbidite::nscd::avx2 {
#include "granular_adapter/nscd/sweeps/lane_kernel.hpp"
#include "granular_adapter/nscd/sweeps/plane/sweep_kernel.hpp"
#include "granular_adapter/nscd/sweeps/sweep_loops.hpp"
}  // namespace turbidite::nscd::avx2
#pragma GCC pop_options

namespace turbidite::nscd {

template <class Rows>
Sweeps<Rows> avx2_sweeps() {
    return avx2::sweeps<Rows>();
}

}  // namespace turbidite::nscd

#else

namespace turbidite::nscd {

template <class Rows>
Sweeps<Rows> avx2_sweeps() {
    throw std::invalid_argument("contact sweeps: this program was built without AVX2");
}

}  // namespace turbidite::nscd

#endif

namespace turbidite::nscd {

template Sweeps<DiscRows<4>> avx2_sweeps();
template Sweeps<DiscRows<1>> avx2_sweeps();
template Sweeps<RollingDiscRows<4>> avx2_sweeps();
template Sweeps<RollingDiscRows<1>> avx2_sweeps();
template Sweeps<GeneralRows<4>> avx2_sweeps();
template Sweeps<GeneralRows<1>> avx2_sweeps();
template Sweeps<AnyRows<1>> avx2_sweeps();

}  // namespace turbidite::nscd
