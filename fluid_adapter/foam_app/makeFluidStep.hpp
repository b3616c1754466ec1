// SPDX-License-Identifier: GPL-3.0-or-later
//
// The implementation of steps 1 to 3 (fluid_window/fluid_step.hpp) that fits the case.
#pragma once

#include <memory>
#include <vector>

#include "coupler/protocol/settings.hpp"
#include "fluid_adapter/fluid_window/fluid_step.hpp"
#include "fluid_adapter/foam_app/fields/createFields.hpp"
#include "fluid_adapter/multiplier/cell_grid.hpp"

namespace turbidite {

/// `cells`: the number i + nx (k + nz j) in the grid of each of this rank's cells. Throws Failure
/// (bad_input), naming the key, if FFT does not fit the mesh or a boundary condition.
std::unique_ptr<FluidStep> make_fluid_step(const Settings& settings, FluidFields& fields,
                                           const CellGrid& grid, const std::vector<int>& cells);

}  // namespace turbidite
