// SPDX-License-Identifier: GPL-3.0-or-later
//
// Step 2, transport: (u2 - u1)/dt + div(phi1 u1) = 0, explicit, conservative with the flux that
// step 1 made free of divergence; the scheme is fvSchemes' div(phi,U).
#pragma once

#include "fluid_adapter/foam_app/createFields.hpp"

namespace turbidite {

/// Over dt [s].
void advect(FluidFields& fields, Foam::scalar dt);

}  // namespace turbidite
