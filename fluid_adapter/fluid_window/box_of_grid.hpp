// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The problems of pressure and viscosity on a grid, by what its sides are: no slip at walls, a
// fixed pressure where they are open. Valid C++17.
#pragma once

#include "fluid_adapter/box_step/box_fluid.hpp"
#include "fluid_adapter/multiplier/cell_grid.hpp"

namespace turbidite {

/// The grid and conditions of u, and of p; the rest of BoxFluid is the caller's.
BoxFluid box_of(const CellGrid& grid);

/// Zero on whole sides.
VelocityOnSides sides_at_rest(const CellGrid& grid);

}  // namespace turbidite
