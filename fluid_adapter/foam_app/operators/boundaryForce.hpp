// SPDX-License-Identifier: GPL-3.0-or-later
//
// What crosses the boundary of the fluid, from the values at its faces: the rates of change of
// momentum over rho_f by pressure, convection and viscosity, per unit length out of the plane
// [m3/s2]. Every function is called by all ranks.
#pragma once

#include "fluid_adapter/fluid_window/fluid_step.hpp"
#include "fluid_adapter/foam_app/fields/createFields.hpp"

namespace turbidite {

BoundaryForce pressure_force(const FluidFields& fields);
BoundaryForce convective_force(const FluidFields& fields);  ///< with phi
BoundaryForce viscous_force(const FluidFields& fields);

}  // namespace turbidite
