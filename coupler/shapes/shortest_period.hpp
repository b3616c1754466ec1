// SPDX-License-Identifier: LGPL-2.1-or-later
//
// How long a cyclic box has to be: contacts take the nearest image of the other grain only, so no
// two grains may touch, or attract each other, on both sides. With d from one centre to the other,
// surfaces are apart by
//
//     g_1 = d - (R1 + R2),   g_2 = L - d - (R1 + R2),   g_1 + g_2 = L - 2 (R1 + R2)
//
// and both gaps can be within the range g_c of a law, or both zero without one, unless
//
//     L > 2 (R1 + R2) + 2 g_c
#pragma once

#include <algorithm>

namespace turbidite {

/// Collects the grains of a box. Two that are held, fixed or driven, have no contact.
class ShortestPeriod {
 public:
    void add(double radius, bool held) {
        second_ = std::max(second_, std::min(first_, radius));
        first_ = std::max(first_, radius);
        if (!held) free_ = std::max(free_, radius);
    }

    /// Of the widest pair that can touch, R1 + R2; 0: no two grains can.
    double pair() const {
        if (free_ == 0.0 || second_ == 0.0) return 0.0;
        // The largest free grain beside the largest of the others.
        return free_ == first_ ? first_ + second_ : first_ + free_;
    }

    /// 2 (R1 + R2) + 2 g_c, which the period must exceed; where no two grains can touch, the
    /// diameter of the largest, which it must reach.
    double length(double range) const {
        return pair() > 0.0 ? 2.0 * (pair() + range) : 2.0 * first_;
    }

    /// `rounding`: relative, within which a period counts as equal to the length.
    bool allows(double period, double range, double rounding = 0.0) const {
        const double least = length(range);
        return pair() > 0.0 ? period > least * (1.0 + rounding) : period >= least;
    }

 private:
    double first_ = 0.0, second_ = 0.0;  ///< largest radii of all
    double free_ = 0.0;                  ///< largest radius of grains that are not held
};

}  // namespace turbidite
