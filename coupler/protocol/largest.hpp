// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// The larger of two values, where NaN counts as the largest: std::max could drop it and hide a
/// failure. Valid C++17.
#pragma once

#include <cmath>

namespace turbidite {

/// NaN if one of them is.
inline double largest(double a, double b) {
    return std::isnan(b) || b > a ? b : a;
}

}  // namespace turbidite
