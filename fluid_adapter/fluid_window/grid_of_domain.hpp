// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The grid of a case's fluid. Valid C++17.
#pragma once

#include "fluid_adapter/domain/fluid_domain.hpp"
#include "fluid_adapter/multiplier/cell_grid.hpp"

namespace turbidite {

/// `thickness`: of the single layer of cells in the plane [m].
CellGrid grid_of(const FluidDomain& domain, double thickness);

}  // namespace turbidite
