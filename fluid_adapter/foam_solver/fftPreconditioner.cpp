// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_solver/fftPreconditioner.hpp"

namespace turbidite {

defineTypeNameAndDebug(FftPreconditioner, 0);

namespace {

const Foam::lduMatrix::preconditioner::addsymMatrixConstructorToTable<FftPreconditioner>
    add_fft_preconditioner;

/// The box with the inverse of the nearest operator; ends the program if the mesh is not a box.
const BoxOfMesh& box_for(const Foam::lduMatrix::solver& solver) {
    try {
        const BoxOfMesh& box = BoxOfMesh::of(solver.matrix());
        // For every solve, as coefficients may have changed since the last one
        box.inverse(solver.fieldName())
            .set(nearest_operator(
                {solver.matrix(), solver.interfaceBouCoeffs(), solver.interfaces()}, box.cells()));
        return box;
    } catch (const DoesNotFit& why) {
        FatalErrorInFunction << "preconditioner FFT does not fit the matrix of "
                             << solver.fieldName() << ": " << why.what() << ".\n"
                             << "    Use `preconditioner DIC;` or `solver GAMG;`, which take any "
                                "mesh."
                             << exit(Foam::FatalError);
        throw;
    }
}

}  // namespace

FftPreconditioner::FftPreconditioner(const Foam::lduMatrix::solver& solver, const Foam::dictionary&)
    : preconditioner(solver), box_(box_for(solver)), inverse_(box_.inverse(solver.fieldName())) {}

void FftPreconditioner::precondition(Foam::solveScalarField& preconditioned,
                                     const Foam::solveScalarField& residual,
                                     const Foam::direction) const {
    inverse_.apply(residual, preconditioned);
}

}  // namespace turbidite
