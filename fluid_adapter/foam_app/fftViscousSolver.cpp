// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/fftViscousSolver.hpp"

#include "fluid_adapter/foam_app/uniformBox.hpp"

namespace turbidite {

FftViscousSolver::FftViscousSolver(Foam::volVectorField& U, Foam::scalar nu)
    : U_(U), nu_(nu), separable_(plane_operator(U)) {}

void FftViscousSolver::solve(Foam::scalar dt) {
    if (factorised_for_ != dt) separable_.factorise({1.0, nu_ * dt});
    factorised_for_ = dt;
    double* values = separable_.values();
    Foam::vectorField& u = U_.primitiveFieldRef();
    for (Foam::direction component : {Foam::vector::X, Foam::vector::Y}) {
        forAll(u, c) values[c] = u[c][component];
        separable_.solve();
        forAll(u, c) u[c][component] = values[c];
    }
    U_.correctBoundaryConditions();
}

}  // namespace turbidite
