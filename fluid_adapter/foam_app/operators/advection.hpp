// SPDX-License-Identifier: GPL-3.0-or-later
//
// Step 2, transport: (u2 - u1)/dt + div(phi1 u1) = 0, explicit, in conservative form with the
// divergence-free flux of step 1; the scheme is fvSchemes' div(phi,U).
#pragma once

#include "fluid_adapter/foam_app/fields/createFields.hpp"

namespace turbidite {

/// One explicit step of dt [s].
void advect(FluidFields& fields, Foam::scalar dt);

}  // namespace turbidite
