// SPDX-License-Identifier: GPL-3.0-or-later
//
// Step 1, degenerate Stokes (Topin 2011, section 2.1.2): the divergence-free velocity closest to u,
//
//     (u1 - u)/dt + grad p = 0,   div u1 = 0        p: over rho_f
//
// On a collocated mesh the constraint holds at the faces: phi1 = phi - dt S.grad p is
// divergence-free, and cells take u1 = u - dt grad p.
//
// The differences between cell values span two cells and do not see what alternates from cell to
// cell. The additional information at the faces, the excess flux e = phi1 - S.u1, must be kept
// between windows: without it a disc released from rest drags more fluid in every window (-3 % of
// its acceleration after 10, -6 % after 20, at any dt). A window therefore starts from S.u + k e
// with k = 1/(1 + 4 nu dt/h2), the fraction of a difference between neighbours that remains after
// viscosity. OpenFOAM's own solvers do the same (Rhie and Chow; `ddtCorr`).
//
// The equation for p is laplacian(p) = (div phi)/dt, with OpenFOAM's matrix and the solver that
// fvSolution names.
#pragma once

#include <fvMatrices.H>

#include "fluid_adapter/foam_app/fields/createFields.hpp"

namespace turbidite {

class StokesProjection {
 public:
    /// `goal`: the largest |div phi| allowed [1/s].
    StokesProjection(FluidFields& fields, Foam::scalar goal);

    /// Projects phi, interpolated from U; sets phi, U and p. Returns max |div phi| [1/s]. Throws
    /// PhysicsRefused if the pressure solver does not converge.
    Foam::scalar project();

 private:
    void solve_pressure(Foam::scalar tighter);
    Foam::scalar kept_share() const;  // k
    void remember();                  // stores e

    FluidFields& fields_;
    Foam::scalar goal_;
    // constant, so that it and the solver's multigrid levels are built once
    Foam::fvScalarMatrix matrix_;
    Foam::dictionary controls_;
    Foam::autoPtr<Foam::fvScalarMatrix::fvSolver> solver_;
    Foam::surfaceScalarField given_;  // flux before the projection
    Foam::scalarField rate_;  // its divergence [1/s], then integrals of (div phi)/dt [m3/s2]
};

}  // namespace turbidite
