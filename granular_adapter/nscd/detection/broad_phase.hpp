// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Candidate pairs by cell lists.
//
// Bodies are sorted into levels by size, a factor of two per level. Every level has its own grid,
// whose cells are as large as the level's largest pair distance. A body searches its own level and
// those of larger bodies, so that a few boulders do not enlarge the cells of the sand.
#pragma once

#include <cstdint>
#include <vector>

#include "granular_adapter/nscd/problem/periodic_box.hpp"
#include "granular_adapter/nscd/threads/thread_team.hpp"

namespace turbidite::nscd {

struct Pair {
    std::int32_t a = 0;  ///< a < b
    std::int32_t b = 0;
};

/// All pairs whose bounding spheres are closer than `alert`, by the minimum image. The order
/// depends only on the input.
std::vector<Pair> candidate_pairs(const std::vector<Vec3>& positions,
                                  const std::vector<double>& radii, double alert,
                                  const PeriodicBox& box);

/// In which order bodies look for their pairs: as they are stored, or cell by cell, where those
/// that look next to each other read the same memory.
enum class PairOrder { by_body, by_cell };

/// The same pairs in one part per thread, which together are in that order; candidate_pairs above
/// has them by body.
std::vector<std::vector<Pair>> candidate_pairs(const std::vector<Vec3>& positions,
                                               const std::vector<double>& radii, double alert,
                                               const PeriodicBox& box, PairOrder order,
                                               ThreadTeam& team);

/// Throws std::invalid_argument if the period of an axis is so short that two bodies, not both
/// fixed, could touch on both sides, or come within the range of the law [m] there: the minimum
/// image sees only one contact.
void check_periods(const std::vector<double>& radii, const std::vector<std::uint8_t>& fixed,
                   double range, const PeriodicBox& box);

}  // namespace turbidite::nscd
