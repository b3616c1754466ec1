// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Contact updates per second of our solver on one core: sweeps times the number of contacts with an
// impulse, over the processor time of whole solves, including set-up and the final check.
#pragma once

#include "bench/timing/figure.hpp"

namespace turbidite::bench {

Measured contact_rate_1397(Site& site);
Measured contact_rate_50000(Site& site);
Measured contact_rate_spheres(Site& site);
Measured contact_cost_growth(Site& site);

/// Wall time of whole windows of spheres on one rank over that on two.
Measured grains_speedup_2_ranks(Site& site);

}  // namespace turbidite::bench
