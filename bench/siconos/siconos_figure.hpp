// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The figure siconos_over_ours of `turbidite bench contact`.
#pragma once

#include "bench/timing/figure.hpp"

namespace turbidite::bench {

/// Time of Siconos' NSGS over that of `nlgs` to the same error measure, 1e-4: geometric mean over
/// the dense dry column at 2, 9 and 14 t_c. Throws Failure if Siconos was not available when the
/// software was built.
Measured siconos_over_ours(Site& site);

}  // namespace turbidite::bench
