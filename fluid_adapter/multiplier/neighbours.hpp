// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Pairs of neighbouring grains by cell lists: the cost is linear in the number of grains. Valid
// C++17.
#pragma once

#include <utility>
#include <vector>

#include "fluid_adapter/multiplier/cell_grid.hpp"
#include "fluid_adapter/multiplier/immersed_grain.hpp"

namespace turbidite {

/// Pairs (a, b), a < b, of grain indices whose circumscribed circles of radius R_h are closer than
/// `margin` [m], periodic images included; each pair once.
std::vector<std::pair<int, int>> near_pairs(const CellGrid& grid,
                                            const std::vector<ImmersedGrain>& grains,
                                            double margin);

}  // namespace turbidite
