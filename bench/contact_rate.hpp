// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Contact-iterations per second of our solver on one core: sweeps times contacts that have an
// impulse, over the processor time of whole solves, set-up and final check included.
#pragma once

#include "bench/figure.hpp"

namespace turbidite::bench {

Measured contact_rate_1397(Site& site);
Measured contact_rate_50000(Site& site);
Measured contact_cost_growth(Site& site);

}  // namespace turbidite::bench
