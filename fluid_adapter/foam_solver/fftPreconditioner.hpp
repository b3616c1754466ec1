// SPDX-License-Identifier: GPL-3.0-or-later
//
// `preconditioner FFT;` of PCG: the inverse of the nearest separable operator, for matrices on a
// box whose coefficients vary. With coefficients between m and M times their axis's mean, the
// condition number of what PCG iterates on is M/m, and the error falls at least by
// (sqrt(M/m) - 1)/(sqrt(M/m) + 1) per iteration, at any number of cells.
#pragma once

#include <lduMatrix.H>

#include "fluid_adapter/foam_solver/boxOfMesh.hpp"

namespace turbidite {

class FftPreconditioner final : public Foam::lduMatrix::preconditioner {
 public:
    using word = Foam::word;  // TypeName means it
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
