// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The coefficients of the two surfaces of a contact. A body carries the index of its material
// (Bodies::material), and so does a wall; the table holds the coefficients of every pair.
//
// Pair rule: the smaller value of each coefficient, unless the pair has values of its own.
#pragma once

#include <cstdint>
#include <vector>

namespace turbidite::nscd {

struct Surface {
    double friction = 0.3;         ///< mu; sliding friction in a law with two coefficients
    double static_friction = 0.0;  ///< mu of sticking contacts (law static-dynamic), >= friction
    double restitution = 0.0;      ///< e_n, [0, 1]
    double restitution_tangential = 0.0;  ///< e_t, [0, 1]
    double rolling_friction = 0.0;        ///< mu_r: lever of the rolling resistance over R*
    /// Force that separates two touching discs of the reference diameter [N].
    double adhesion = 0.0;
    double torsion_friction = 0.0;  ///< lever of the torsional resistance over R*, in space
};

/// Coefficients of one pair that do not follow the rule.
struct SurfacePair {
    std::int32_t first = 0;
    std::int32_t second = 0;
    Surface values;
};

class SurfaceTable {
 public:
    /// Throws std::invalid_argument if there is no surface, and naming the material and the value
    /// for a coefficient that is negative or not a number, a restitution outside [0, 1], or a pair
    /// with an unknown material.
    explicit SurfaceTable(std::vector<Surface> surfaces, std::vector<SurfacePair> pairs = {});

    std::int32_t size() const { return count_; }

    /// Coefficients of a pair of materials in [0, size()); symmetric.
    const Surface& pair(std::int32_t a, std::int32_t b) const {
        return pairs_[static_cast<std::size_t>(a * count_ + b)];
    }

    /// The largest restitution, normal or tangential, of all pairs.
    double largest_restitution() const;

    /// Of all pairs, for checks.
    const std::vector<Surface>& all_pairs() const { return pairs_; }

 private:
    std::int32_t count_;
    std::vector<Surface> pairs_;  ///< count x count
};

}  // namespace turbidite::nscd
