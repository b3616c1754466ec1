// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/operators/viscousDiffusion.hpp"

#include <fvcLaplacian.H>
#include <fvmLaplacian.H>
#include <fvmSup.H>

#include "coupler/protocol/failure.hpp"

namespace turbidite {

void ViscousDiffusion::assemble(Foam::scalar dt) {
    const Foam::dimensionedScalar rate("rate", Foam::dimless / Foam::dimTime, 1.0 / dt);
    const Foam::dimensionedScalar nu("nu", Foam::dimViscosity, fields_.nu);
    // (1/dt - nu laplacian) u3 = u2/dt
    matrix_ = std::make_unique<Foam::fvVectorMatrix>(Foam::fvm::Sp(rate, fields_.U) -
                                                     Foam::fvm::laplacian(nu, fields_.U));
    assembled_for_ = dt;
}

Foam::tmp<Foam::vectorField> ViscousDiffusion::acceleration() const {
    const Foam::dimensionedScalar nu("nu", Foam::dimViscosity, fields_.nu);
    return Foam::tmp<Foam::vectorField>::New(Foam::fvc::laplacian(nu, fields_.U)->primitiveField());
}

void ViscousDiffusion::solve(Foam::scalar dt) {
    if (assembled_for_ != dt) assemble(dt);
    // Integrated over cells, as the matrix is, which has what the sides hold.
    matrix_->source() = fields_.mesh.V().field() / dt * fields_.U.primitiveField();
    const Foam::dictionary& controls = fields_.mesh.solverDict(fields_.U.name());
    const auto result = matrix_->solve(controls);
    // This version never sets the convergence flag of a vector; reaching the maximum of iterations
    // tells.
    const Foam::label most = controls.getOrDefault<Foam::label>("maxIter", 1000);
    if (Foam::cmptMax(result.nIterations()) >= most)
        throw PhysicsRefused("the viscous solver did not converge in " + std::to_string(most) +
                             " iterations");
}

}  // namespace turbidite
