// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The sweeps of spheres for any processor.
#include "granular_adapter/nscd/sweeps/space/sphere_rows.hpp"

#if defined(__GNUC__) && !defined(__clang__)
// Vectors of four doubles are passed in two registers here; no function passes them to another
// library.
#pragma GCC diagnostic ignored "-Wpsabi"
#endif

namespace turbidite::nscd {
namespace portable {
#include "granular_adapter/nscd/sweeps/lane_kernel.hpp"
#include "granular_adapter/nscd/sweeps/space/sphere_kernel.hpp"
#include "granular_adapter/nscd/sweeps/sweep_loops.hpp"
}  // namespace portable

template <class Rows>
Sweeps<Rows> portable_sweeps() {
    return portable::sweeps<Rows>();
}

template Sweeps<SphereRows<4>> portable_sweeps();
template Sweeps<SphereRows<1>> portable_sweeps();
template Sweeps<BiasedSphereRows<4>> portable_sweeps();
template Sweeps<BiasedSphereRows<1>> portable_sweeps();
template Sweeps<TurningSphereRows<4>> portable_sweeps();
template Sweeps<TurningSphereRows<1>> portable_sweeps();
template Sweeps<FilmSphereRows<4>> portable_sweeps();
template Sweeps<FilmSphereRows<1>> portable_sweeps();

}  // namespace turbidite::nscd
