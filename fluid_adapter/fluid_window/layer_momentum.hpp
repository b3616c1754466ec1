// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The momentum of a fluid in space whose ranks have whole layers of cells. Valid C++17.
#pragma once

#include <array>

#include "fluid_adapter/fluid_window/fluid_store.hpp"

namespace turbidite {

/// `u`: its components over this rank's cells. Collective.
FluidMomentum momentum_of_layers(const FluidField& field, const std::array<double*, 3>& u,
                                 const RankGroup& ranks);

}  // namespace turbidite
