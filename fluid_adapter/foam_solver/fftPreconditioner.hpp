// SPDX-License-Identifier: GPL-3.0-or-later
//
// `preconditioner FFT;` of PCG: the inverse of the nearest separable operator, for matrices on a
// box with variable coefficients. With coefficients between m and M times the mean of their axis,
// the preconditioned matrix has the condition number M/m, and the error decreases at least by the
// factor (sqrt(M/m) - 1)/(sqrt(M/m) + 1) per iteration, for any number of cells.
#pragma once

#include <lduMatrix.H>

#include "fluid_adapter/foam_solver/boxOfMesh.hpp"

namespace turbidite {

class FftPreconditioner final : public Foam::lduMatrix::preconditioner {
 public:
    using word = Foam::word;  // used by the macro TypeName
    TypeName("FFT");

    FftPreconditioner(const Foam::lduMatrix::solver& solver, const Foam::dictionary& controls);

    void precondition(Foam::solveScalarField& preconditioned,
                      const Foam::solveScalarField& residual,
                      const Foam::direction component = 0) const override;

 private:
    const BoxOfMesh& box_;
    BoxInverse& inverse_;
};

}  // namespace turbidite
