// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The divergence of a velocity in cells of a box in space, with the flux between cells from their
// mean weighted by volumes, as OpenFOAM's reverseLinear has it. Valid C++17.
#pragma once

#include "fluid_adapter/box_step/box_rows.hpp"
#include "fluid_adapter/box_step/side_values.hpp"
#include "fluid_adapter/multiplier/fluid_field.hpp"

namespace turbidite {

/// The largest on this rank [1/s]; every rank calls it. `sides`: what u is on them.
double largest_central_divergence(FluidField& field, BoxRows& rows, const VelocityOnSides& sides);

}  // namespace turbidite
