// SPDX-License-Identifier: GPL-2.0-or-later
//
// The number of sub-steps of transport. Forward Euler with a limiter of at most 1 keeps u within
// its bounds up to a Courant number of 2/3, and jets between grains are several times as fast as
// the grains themselves. Valid C++17.
#pragma once

#include <algorithm>
#include <cmath>

namespace turbidite {

/// At least one, also for a Courant number that is NaN, which is refused elsewhere.
inline int transport_parts(double courant, double limit = 2.0 / 3.0) {
    constexpr double most = 1000.0;
    return std::isfinite(courant)
               ? static_cast<int>(std::clamp(std::ceil(courant / limit), 1.0, most))
               : 1;
}

}  // namespace turbidite
