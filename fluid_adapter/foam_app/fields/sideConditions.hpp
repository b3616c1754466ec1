// SPDX-License-Identifier: GPL-3.0-or-later
//
// What 0/U and 0/p of a fluid in space may say of its sides.
#pragma once

#include "fluid_adapter/foam_app/fields/createFields.hpp"
#include "fluid_adapter/multiplier/cell_grid.hpp"

namespace turbidite {

/// The steps in space take from the grid which sides are walls (inflows among them), free or
/// cyclic, and from U only the values that walls hold. Throws Failure (bad_input), naming field,
/// patch and condition, where the files say anything else. Every rank calls it.
void demand_conditions_of_grid(const FluidFields& fields, const CellGrid& grid);

}  // namespace turbidite
