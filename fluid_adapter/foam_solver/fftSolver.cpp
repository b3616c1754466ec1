// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_solver/fftSolver.hpp"

#include <PrecisionAdaptor.H>

namespace turbidite {

defineTypeNameAndDebug(FftSolver, 0);

namespace {
const Foam::lduMatrix::solver::addsymMatrixConstructorToTable<FftSolver> add_fft_solver;
}

FftSolver::FftSolver(const Foam::word& field, const Foam::lduMatrix& matrix,
                     const Foam::FieldField<Foam::Field, Foam::scalar>& boundary_coeffs,
                     const Foam::FieldField<Foam::Field, Foam::scalar>& internal_coeffs,
                     const Foam::lduInterfaceFieldPtrsList& interfaces,
                     const Foam::dictionary& controls)
    : solver(field, matrix, boundary_coeffs, internal_coeffs, interfaces, controls) {}

/// The box with the inverse of the matrix; ends the program if there is none.
const BoxOfMesh& FftSolver::checked_box() const {
    try {
        const BoxOfMesh& box = BoxOfMesh::of(matrix_);
        box.inverse(fieldName_)
            .set(exact_operator({matrix_, interfaceBouCoeffs_, interfaces_}, box.cells()));
        return box;
    } catch (const DoesNotFit& why) {
        FatalIOErrorInFunction(controlDict_)
            << "solver FFT does not fit the matrix of " << fieldName_ << ": " << why.what() << ".\n"
            << "    Use `solver PCG; preconditioner FFT;` (a box with other coefficients) or "
               "`solver GAMG;` (any mesh)."
            << exit(Foam::FatalIOError);
        throw;
    }
}

/// residual = source - A psi; returns the sum of its absolute values.
Foam::scalar FftSolver::residual_sum(Foam::solveScalarField& residual,
                                     const Foam::solveScalarField& psi,
                                     const Foam::solveScalarField& source,
                                     Foam::direction component) const {
    matrix_.Amul(residual, psi, interfaceBouCoeffs_, interfaces_, component);
    forAll(residual, c) residual[c] = source[c] - residual[c];
    return Foam::gSumMag(residual, matrix_.mesh().comm());
}

Foam::solverPerformance FftSolver::scalarSolve(Foam::solveScalarField& psi,
                                               const Foam::solveScalarField& source,
                                               const Foam::direction component) const {
    const BoxOfMesh& box = checked_box();
    BoxInverse& inverse = box.inverse(fieldName_);
    Foam::solverPerformance performance(typeName, fieldName_);
    Foam::solveScalarField residual(psi.size()), correction(psi.size());

    matrix_.Amul(correction, psi, interfaceBouCoeffs_, interfaces_, component);
    // OpenFOAM's own norm, so that tolerance and relTol mean what they mean for other solvers.
    const Foam::scalar norm = normFactor(psi, source, correction, residual);
    performance.initialResidual() = residual_sum(residual, psi, source, component) / norm;
    performance.finalResidual() = performance.initialResidual();

    bool halved = true;
    while (performance.nIterations() < minIter_ ||
           (halved && performance.nIterations() < maxIter_ &&
            !performance.checkConvergence(tolerance_, relTol_))) {
        // psi += A^-1 (source - A psi)
        inverse.apply(residual, correction);
        psi += correction;
        const Foam::scalar before = performance.finalResidual();
        performance.finalResidual() = residual_sum(residual, psi, source, component) / norm;
        halved = performance.finalResidual() < 0.5 * before;
        ++performance.nIterations();
    }
    performance.checkConvergence(tolerance_, relTol_);
    matrix_.setResidualField(
        Foam::ConstPrecisionAdaptor<Foam::scalar, Foam::solveScalar>(residual)(), fieldName_,
        false);
    return performance;
}

Foam::solverPerformance FftSolver::solve(Foam::scalarField& psi, const Foam::scalarField& source,
                                         const Foam::direction component) const {
    Foam::PrecisionAdaptor<Foam::solveScalar, Foam::scalar> precise(psi);
    return scalarSolve(precise.ref(),
                       Foam::ConstPrecisionAdaptor<Foam::solveScalar, Foam::scalar>(source)(),
                       component);
}

}  // namespace turbidite
