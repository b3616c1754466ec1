// SPDX-License-Identifier: GPL-3.0-or-later
//
// Step 1, degenerated Stokes (Topin 2011, section 2.2): the velocity nearest to u that has no
// divergence,
//
//     (u1 - u)/dt + grad p = 0,   div u1 = 0        p: over rho_f
//
// On a collocated mesh the faces carry the constraint: phi1 = phi - dt S.grad p has no divergence,
// and cells take u1 = u - dt grad p.
#pragma once

#include <memory>

#include "fluid_adapter/foam_app/createFields.hpp"
#include "fluid_adapter/foam_app/pressureSolver.hpp"

namespace turbidite {

class StokesProjection {
 public:
    /// `goal`: the largest |div phi| asked for [1/s].
    StokesProjection(FluidFields& fields, Foam::scalar goal);

    /// From phi = interpolated U to the projected phi, U and p. Returns max |div phi| [1/s].
    Foam::scalar project();

 private:
    FluidFields& fields_;
    Foam::scalar goal_;
    std::unique_ptr<PressureSolver> solver_;
    Foam::surfaceScalarField given_;  // flux before the projection
};

}  // namespace turbidite
