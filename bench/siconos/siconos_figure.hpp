// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The figures siconos_over_ours and spheres_over_siconos of `turbidite bench contact`.
#pragma once

#include "bench/timing/figure.hpp"

namespace turbidite::bench {

/// Time of Siconos' NSGS over that of `nlgs` to the same error measure, 1e-4: geometric mean over
/// the dense dry column at 2, 9 and 14 t_c. Throws Failure if Siconos was not available when the
/// software was built.
Measured siconos_over_ours(Site& site);

/// The same for spheres: time of the fastest of Siconos' Gauss-Seidel solvers for friction in space
/// over that of `nlgs`, both told how many sweeps reach the error; geometric mean over a column of
/// 544 spheres at 1, 3 and 6 t_c.
Measured spheres_over_siconos(Site& site);

}  // namespace turbidite::bench
