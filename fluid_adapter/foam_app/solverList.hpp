// SPDX-License-Identifier: GPL-3.0-or-later
//
// The solvers of the pressure and of the viscous problem by name: the values of the keys
// fluid.pressure_solver and fluid.viscous_solver.
#pragma once

#include <memory>
#include <string>

#include "fluid_adapter/foam_app/createFields.hpp"
#include "fluid_adapter/foam_app/pressureSolver.hpp"
#include "fluid_adapter/foam_app/viscousDiffusion.hpp"

namespace turbidite {

/// Throw Failure (bad_input), naming the key, for an unknown name and for a solver that does not
/// fit the mesh or its boundary conditions.
std::unique_ptr<PressureSolver> make_pressure_solver(const std::string& name, FluidFields& fields);
std::unique_ptr<ViscousSolver> make_viscous_solver(const std::string& name, FluidFields& fields);

}  // namespace turbidite
