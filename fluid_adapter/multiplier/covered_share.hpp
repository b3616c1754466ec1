// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The share of each cell that grains cover (indicator function), for output. Valid C++17.
#pragma once

#include <vector>

#include "fluid_adapter/multiplier/fluid_field.hpp"
#include "fluid_adapter/multiplier/immersed_grain.hpp"

namespace turbidite {

/// By owned cell, from 0 to 1: samples in 8 x 8 places of a cell, exact to a few per cent of a cell
/// on a grain's surface. `grains`: all that touch this rank's cells, with their hydrodynamic radii.
std::vector<double> covered_share(const FluidField& field,
                                  const std::vector<ImmersedGrain>& grains);

}  // namespace turbidite
