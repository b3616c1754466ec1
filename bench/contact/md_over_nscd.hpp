// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The dry column of configs/avalanche-dry.yaml by molecular dynamics and by contact dynamics, both
// hosted by YADE on one core: the relative cost of the same answer.
#pragma once

#include "bench/timing/figure.hpp"

namespace turbidite::bench {

/// Wall time of the grains program with yade-md over that with yade-nscd. The notes tell whether
/// overlaps stayed below 1e-3 D (MD) and the 95th percentile of the natural map below 1e-3 (NSCD);
/// otherwise the answers are not comparable.
Measured md_over_nscd_dry_column(Site& site);

}  // namespace turbidite::bench
