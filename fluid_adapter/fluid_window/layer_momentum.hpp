// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A fluid in space whose ranks have whole layers of cells: its momentum, and layers of other ranks.
// Valid C++17.
#pragma once

#include <array>

#include "fluid_adapter/fluid_window/fluid_store.hpp"

namespace turbidite {

/// `u`: its components over this rank's cells. Collective.
FluidMomentum momentum_of_layers(const FluidField& field, const std::array<double*, 3>& u,
                                 const RankGroup& ranks);

/// FluidField::import_layers by way of the step's rows.
void import_layers_of(BoxRows& rows, const VelocityPointers& u, const LayerCells& cells,
                      LayersBeside& beside);

}  // namespace turbidite
