// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Pair tests of triangles that fill the plane, per second on one core: pairs whose circumscribed
// circles are within the alert distance, over the processor time of placing all corners and testing
// all those pairs.
#pragma once

#include "bench/timing/figure.hpp"

namespace turbidite::bench {

Measured polygon_detections_per_second(Site& site);

}  // namespace turbidite::bench
