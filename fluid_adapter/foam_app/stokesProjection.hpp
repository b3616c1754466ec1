// SPDX-License-Identifier: GPL-3.0-or-later
//
// Step 1, degenerated Stokes (Topin 2011, section 2.2): the velocity nearest to u that has no
// divergence,
//
//     (u1 - u)/dt + grad p = 0,   div u1 = 0        p: over rho_f
//
// On a collocated mesh the faces carry the constraint: phi1 = phi - dt S.grad p has no divergence,
// and cells take u1 = u - dt grad p.
//
// The cells' own differences are twice as wide and do not see what alternates from cell to cell.
// What the faces know beyond them, e = phi1 - S.u1, must not be forgotten between windows: without
// it a disc let go drags more fluid window after window (-3 % of its acceleration after 10, -6 %
// after 20, at any dt). A window therefore starts from S.u + k e with k = 1/(1 + 4 nu dt/h2), the
// share that viscosity leaves of a difference between neighbours: OpenFOAM's own solvers do the
// same (Rhie and Chow; `ddtCorr`).
//
// p: laplacian(p) = (div phi)/dt with OpenFOAM's matrix and the solver that fvSolution names.
#pragma once

#include <fvMatrices.H>

#include "fluid_adapter/foam_app/createFields.hpp"

namespace turbidite {

class StokesProjection {
 public:
    /// `goal`: the largest |div phi| asked for [1/s].
    StokesProjection(FluidFields& fields, Foam::scalar goal);

    /// From phi = interpolated U to the projected phi, U and p. Returns max |div phi| [1/s]. Throws
    /// PhysicsRefused when the pressure solver does not converge.
    Foam::scalar project();

 private:
    void solve_pressure(Foam::scalar tighter);
    Foam::scalar kept_share() const;  // k
    void remember();                  // e

    FluidFields& fields_;
    Foam::scalar goal_;
    Foam::fvScalarMatrix matrix_;  // never changes, so it and the solver's levels are built once
    Foam::dictionary controls_;
    Foam::autoPtr<Foam::fvScalarMatrix::fvSolver> solver_;
    Foam::surfaceScalarField given_;  // flux before the projection
    Foam::scalarField rate_;  // its divergence [1/s], then integrals of (div phi)/dt [m3/s2]
};

}  // namespace turbidite
