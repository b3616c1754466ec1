// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The dry column of configs/avalanche-dry.yaml by molecular dynamics and by contact dynamics, both
// hosted by YADE on one core: what the same answer costs.
#pragma once

#include "bench/figure.hpp"

namespace turbidite::bench {

/// Wall time of the grains program with yade-md over that with yade-nscd. The notes say whether
/// overlaps stayed below 1e-3 D (MD) and the 95th percentile of the natural map below 1e-3 (NSCD),
/// without which the ratio compares unequal answers.
Measured md_over_nscd_dry_column(Site& site);

}  // namespace turbidite::bench
