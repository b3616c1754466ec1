// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The larger of two reports, where not-a-number counts as the largest of all: std::max would drop
// it, and with it the news that something has failed. Valid C++17.
#pragma once

#include <cmath>

namespace turbidite {

inline double largest(double a, double b) {
    return std::isnan(b) || b > a ? b : a;
}

}  // namespace turbidite
