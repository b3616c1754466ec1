// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/fftViscousSolver.hpp"

namespace turbidite {

FftViscousSolver::FftViscousSolver(Foam::volVectorField& U, Foam::scalar nu, const RankGroup& ranks)
    : FftViscousSolver(U, nu, ranks, uniform_box(U.mesh())) {}

FftViscousSolver::FftViscousSolver(Foam::volVectorField& U, Foam::scalar nu, const RankGroup& ranks,
                                   const UniformBox& box)
    : U_(U),
      nu_(nu),
      rows_(cell_rows(ranks, box)),
      separable_(plane_operator(U, box), rows_.pencils()) {}

void FftViscousSolver::solve(Foam::scalar dt) {
    if (factorised_for_ != dt) separable_.factorise({1.0, nu_ * dt});
    factorised_for_ = dt;
    double* values = separable_.values();
    Foam::vectorField& u = U_.primitiveFieldRef();
    for (Foam::direction component : {Foam::vector::X, Foam::vector::Y}) {
        rows_.gather([&](int c) { return u[c][component]; }, values);
        separable_.solve();
        rows_.scatter(values, [&](int c, double value) { u[c][component] = value; });
    }
    U_.correctBoundaryConditions();
}

}  // namespace turbidite
