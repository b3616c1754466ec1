// SPDX-License-Identifier: GPL-3.0-or-later
//
// `solver FFT;` in an OpenFOAM case's fvSolution: a direct solver for a symmetric separable matrix.
// Every call reads the coefficients and refuses those that do not fit.
//
// An iteration corrects psi by A^-1 of its residual. One is enough, unless rounding or coefficients
// that differ by up to coefficient_tolerance leave more than the tolerance; iteration ends when the
// tolerance is met or the residual is no longer halved.
#pragma once

#include <lduMatrix.H>

#include "fluid_adapter/foam_solver/boxOfMesh.hpp"

namespace turbidite {

class FftSolver final : public Foam::lduMatrix::solver {
 public:
    using word = Foam::word;  // used by the macro TypeName
    TypeName("FFT");

    FftSolver(const Foam::word& field, const Foam::lduMatrix& matrix,
              const Foam::FieldField<Foam::Field, Foam::scalar>& boundary_coeffs,
              const Foam::FieldField<Foam::Field, Foam::scalar>& internal_coeffs,
              const Foam::lduInterfaceFieldPtrsList& interfaces, const Foam::dictionary& controls);

    Foam::solverPerformance solve(Foam::scalarField& psi, const Foam::scalarField& source,
                                  const Foam::direction component = 0) const override;

    Foam::solverPerformance scalarSolve(Foam::solveScalarField& psi,
                                        const Foam::solveScalarField& source,
                                        const Foam::direction component = 0) const override;

 private:
    const BoxOfMesh& checked_box() const;
    Foam::scalar residual_sum(Foam::solveScalarField& residual, const Foam::solveScalarField& psi,
                              const Foam::solveScalarField& source,
                              Foam::direction component) const;
};

}  // namespace turbidite
