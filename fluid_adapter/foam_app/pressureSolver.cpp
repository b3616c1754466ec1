// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/pressureSolver.hpp"

#include <fvmLaplacian.H>
#include <volFields.H>

#include "coupler/protocol/failure.hpp"

namespace turbidite {

MatrixPressureSolver::MatrixPressureSolver(Foam::volScalarField& p)
    : matrix_(Foam::fvm::laplacian(p)), controls_(p.mesh().solverDict(p.name())) {
    p.mesh().setFluxRequired(p.name());
    // Where no side fixes p: in one cell of all ranks'.
    matrix_.setReference(Foam::Pstream::master() ? 0 : -1, 0.0);
    solver_ = matrix_.solver(controls_);
}

void MatrixPressureSolver::solve(const Foam::scalarField& f, Foam::scalar tighter) {
    matrix_.source() = f;
    Foam::dictionary controls(controls_);
    controls.set("tolerance", tighter * controls_.get<Foam::scalar>("tolerance"));
    const Foam::solverPerformance result = solver_->solve(controls);
    if (!result.converged())
        throw PhysicsRefused("the pressure solver " + result.solverName() + " stopped after " +
                             std::to_string(result.nIterations()) + " iterations at residual " +
                             std::to_string(result.finalResidual()));
}

Foam::tmp<Foam::surfaceScalarField> MatrixPressureSolver::gradient_flux() const {
    return matrix_.flux();
}

}  // namespace turbidite
