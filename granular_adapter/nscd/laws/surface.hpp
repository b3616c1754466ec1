// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What laws need to know about the two surfaces of a contact. A body carries the index of its
// material (Bodies::material), a wall its own; the table answers for every pair.
//
// Pair rule: the smaller value of each coefficient, unless the pair was given values of its own.
#pragma once

#include <cstdint>
#include <vector>

namespace turbidite::nscd {

struct Surface {
    double friction = 0.3;         ///< mu; where a law has two, the one of sliding contacts
    double static_friction = 0.0;  ///< mu of contacts that stick (law static-dynamic), >= friction
    double restitution = 0.0;      ///< e_n, [0, 1]
    double restitution_tangential = 0.0;  ///< e_t, [0, 1]
    double rolling_friction = 0.0;        ///< mu_r: lever of the rolling resistance over R*
    double adhesion = 0.0;  ///< pull that parts two touching discs of the reference diameter [N]
};

/// Values of one pair that the rule would not give.
struct SurfacePair {
    std::int32_t first = 0;
    std::int32_t second = 0;
    Surface values;
};

class SurfaceTable {
 public:
    /// Throws std::invalid_argument naming the material and the value when a coefficient is
    /// negative or not a number, a restitution outside [0, 1], or a pair of a material that is not
    /// there; when there is no surface at all.
    explicit SurfaceTable(std::vector<Surface> surfaces, std::vector<SurfacePair> pairs = {});

    std::int32_t size() const { return count_; }

    /// Of materials in [0, size()); symmetric.
    const Surface& pair(std::int32_t a, std::int32_t b) const {
        return pairs_[static_cast<std::size_t>(a * count_ + b)];
    }

    double largest_restitution() const;

    /// Of every pair, for checks.
    const std::vector<Surface>& all_pairs() const { return pairs_; }

 private:
    std::int32_t count_;
    std::vector<Surface> pairs_;  ///< count x count
};

}  // namespace turbidite::nscd
