// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Candidate pairs by cell lists.
//
// Bodies are sorted into levels by size, a factor of two per level, and every level has its own
// grid whose cells are as large as the level's largest pair distance. A body looks in its own level
// and in those of larger bodies, so that a few boulders do not make the cells of sand grow.
#pragma once

#include <cstdint>
#include <vector>

#include "granular_adapter/nscd/problem/periodic_box.hpp"

namespace turbidite::nscd {

struct Pair {
    std::int32_t a = 0;  ///< a < b
    std::int32_t b = 0;
};

/// All pairs whose bounding spheres are closer than `alert`, nearest images taken. The order
/// depends on the input only.
std::vector<Pair> candidate_pairs(const std::vector<Vec3>& positions,
                                  const std::vector<double>& radii, double alert,
                                  const PeriodicBox& box);

/// Throws std::invalid_argument when an axis repeats so soon that two bodies could touch on both
/// sides: the minimum image sees one contact only.
void check_periods(const std::vector<double>& radii, const PeriodicBox& box);

}  // namespace turbidite::nscd
