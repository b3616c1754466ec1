// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Which grains are near which, by cell lists: work grows with the number of grains, not with its
// square. Valid C++17.
#pragma once

#include <utility>
#include <vector>

#include "fluid_adapter/multiplier/cell_grid.hpp"
#include "fluid_adapter/multiplier/immersed_grain.hpp"

namespace turbidite {

/// Pairs (a, b), a < b, of indices of grains whose circumscribed circles of radius R_h come nearer
/// than `margin` [m], images across cyclic sides included; every pair once.
std::vector<std::pair<int, int>> near_pairs(const CellGrid& grid,
                                            const std::vector<ImmersedGrain>& grains,
                                            double margin);

}  // namespace turbidite
