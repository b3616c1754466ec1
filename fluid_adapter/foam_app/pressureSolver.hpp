// SPDX-License-Identifier: GPL-3.0-or-later
//
// The pressure problem of step 1 behind one door, so that a direct solver can stand in for
// OpenFOAM's iterative ones:  laplacian(p) = f  with the boundary conditions of p.
#pragma once

#include <fvMatrices.H>

#include <memory>

namespace turbidite {

class PressureSolver {
 public:
    virtual ~PressureSolver() = default;

    /// Solves for the p the solver was made with. f: integrals over cells [m3/s2]; `tighter`, at
    /// most one, multiplies the tolerance of an iterative solver. Throws PhysicsRefused when there
    /// is no convergence.
    virtual void solve(const Foam::scalarField& f, Foam::scalar tighter) = 0;

    /// |S_f| grad p . n through the faces, with the differences of the solve.
    virtual Foam::tmp<Foam::surfaceScalarField> gradient_flux() const = 0;
};

/// With OpenFOAM's matrix and the solver that fvSolution names. The matrix never changes, so it and
/// the solver's coarse levels are built once.
class MatrixPressureSolver final : public PressureSolver {
 public:
    explicit MatrixPressureSolver(Foam::volScalarField& p);

    void solve(const Foam::scalarField& f, Foam::scalar tighter) override;
    Foam::tmp<Foam::surfaceScalarField> gradient_flux() const override;

 private:
    Foam::fvScalarMatrix matrix_;
    Foam::dictionary controls_;
    Foam::autoPtr<Foam::fvScalarMatrix::fvSolver> solver_;
};

}  // namespace turbidite
