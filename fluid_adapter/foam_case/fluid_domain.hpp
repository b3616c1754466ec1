// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The fluid's box and its uniform grid, from the resolved case: counts = size / D x cells per
// diameter, rounded, so that cells are as nearly square as the box allows. Valid C++17.
#pragma once

#include <array>
#include <string>

#include "coupler/protocol/settings.hpp"

namespace turbidite {

struct FluidDomain {
    std::array<double, 2> size{};  ///< [m]
    std::array<int, 2> cells{};
    double thickness = 0.0;  ///< of the single layer of cells [m]; results are per unit length
    /// wall, free, cyclic or inflow: left, right, bottom, top.
    std::array<std::string, 4> sides{};
};

inline constexpr std::array<const char*, 4> side_names = {"left", "right", "bottom", "top"};

/// Throws Failure (bad_input) that names the key.
FluidDomain fluid_domain(const Settings& settings);

}  // namespace turbidite
