// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/fftPressureSolver.hpp"

#include <surfaceFields.H>

namespace turbidite {
namespace {

/// Of any cell: all are equal.
Foam::scalar cell_volume(const Foam::fvMesh& mesh, const UniformBox& box) {
    return box.spacing[0] * box.spacing[1] * mesh.bounds().span().z();
}

}  // namespace

FftPressureSolver::FftPressureSolver(Foam::volScalarField& p, const RankGroup& ranks)
    : FftPressureSolver(p, ranks, uniform_box(p.mesh())) {}

FftPressureSolver::FftPressureSolver(Foam::volScalarField& p, const RankGroup& ranks,
                                     const UniformBox& box)
    : FftPressureSolver(p, ranks, box, plane_operator(p, box)) {}

FftPressureSolver::FftPressureSolver(Foam::volScalarField& p, const RankGroup& ranks,
                                     const UniformBox& box, const PlaneOperator& plane)
    : p_(p),
      floating_(plane.x.has_zero_mode() && plane.y.has_zero_mode()),
      cell_volume_(cell_volume(p.mesh(), box)),
      conductance_("conductance", p.mesh().magSf() * p.mesh().deltaCoeffs()),
      rows_(cell_rows(ranks, box)),
      separable_(plane, rows_.pencils()) {
    separable_.factorise({0.0, 1.0});
}

void FftPressureSolver::solve(const Foam::scalarField& f, Foam::scalar) {
    double* values = separable_.values();
    rows_.gather([&](int c) { return -f[c] / cell_volume_; }, values);
    separable_.solve();
    const Foam::scalar level = floating_ ? rows_.first(values) : 0.0;
    Foam::scalarField& p = p_.primitiveFieldRef();
    rows_.scatter(values, [&](int c, double value) { p[c] = value - level; });
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
