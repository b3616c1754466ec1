// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/fftPressureSolver.hpp"

#include <surfaceFields.H>

#include "fluid_adapter/foam_app/uniformBox.hpp"

namespace turbidite {

FftPressureSolver::FftPressureSolver(Foam::volScalarField& p)
    : FftPressureSolver(p, plane_operator(p)) {}

FftPressureSolver::FftPressureSolver(Foam::volScalarField& p, const PlaneOperator& plane)
    : p_(p),
      floating_(plane.x.has_zero_mode() && plane.y.has_zero_mode()),
      cell_volume_(p.mesh().V()[0]),
      conductance_("conductance", p.mesh().magSf() * p.mesh().deltaCoeffs()),
      separable_(plane) {
    separable_.factorise({0.0, 1.0});
}

void FftPressureSolver::solve(const Foam::scalarField& f, Foam::scalar) {
    double* values = separable_.values();
    forAll(f, c) values[c] = -f[c] / cell_volume_;
    separable_.solve();
    const Foam::scalar level = floating_ ? values[0] : 0.0;
    Foam::scalarField& p = p_.primitiveFieldRef();
    forAll(p, c) p[c] = values[c] - level;
    p_.correctBoundaryConditions();
}

Foam::tmp<Foam::surfaceScalarField> FftPressureSolver::gradient_flux() const {
    auto flux = Foam::surfaceScalarField::New("pressureGradientFlux", p_.mesh(),
                                              p_.dimensions() * Foam::dimLength);
    const Foam::labelUList& owner = p_.mesh().owner();
    const Foam::labelUList& neighbour = p_.mesh().neighbour();
    Foam::scalarField& inner = flux.ref().primitiveFieldRef();
    forAll(inner, face) inner[face] = conductance_[face] * (p_[neighbour[face]] - p_[owner[face]]);
    auto& sides = flux.ref().boundaryFieldRef();
    forAll(sides, patch) {
        const auto& p_side = p_.boundaryField()[patch];
        sides[patch] =
            p_.mesh().magSf().boundaryField()[patch] *
            (p_side.coupled() ? p_side.snGrad(p_side.patch().deltaCoeffs()) : p_side.snGrad());
    }
    return flux;
}

}  // namespace turbidite
