// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/operators/laplacianOperator.hpp"

#include <fvmLaplacian.H>

#include <algorithm>

namespace turbidite {
namespace {

/// Conditions that always hold a value or always a gradient, or that couple cells.
constexpr const char* lasting_conditions[] = {"zeroGradient",    "fixedGradient", "fixedValue",
                                              "noSlip",          "cyclic",        "processor",
                                              "processorCyclic", "empty"};

template <class Type>
using VolField = Foam::GeometricField<Type, Foam::fvPatchField, Foam::volMesh>;

template <class Type>
std::string switching_condition(const VolField<Type>& field) {
    for (const auto& condition : field.boundaryField()) {
        const auto is_same = [&](const char* name) { return condition.type() == name; };
        if (!std::any_of(std::begin(lasting_conditions), std::end(lasting_conditions), is_same))
            return "condition " + condition.type() + " on patch " + condition.patch().name();
    }
    return {};
}

/// What the boundary may contribute to the right-hand side.
enum class Held { anything, values, nothing };

/// Names a patch that contributes to the right-hand side, because the value or gradient it holds is
/// not zero, and may not; empty if there is none.
template <class Type>
std::string inhomogeneous_condition(const Foam::fvMatrix<Type>& matrix, Held allowed) {
    if (allowed == Held::anything) return {};
    forAll(matrix.psi().boundaryField(), patch) {
        const auto& condition = matrix.psi().boundaryField()[patch];
        if (condition.coupled() || condition.size() == 0) continue;
        // Rows have values on their sides (box_step/side_values.hpp).
        if (allowed == Held::values && condition.fixesValue()) continue;
        if (Foam::max(Foam::mag(matrix.boundaryCoeffs()[patch])) > 0.0)
            return "the value or gradient fixed on patch " + condition.patch().name() +
                   " is not zero";
    }
    return {};
}

Foam::fvScalarMatrix laplacian(Foam::volScalarField& p) {
    return Foam::fvScalarMatrix(Foam::fvm::laplacian(p));
}

/// The same for all components: none of the conditions above distinguishes them.
Foam::fvVectorMatrix laplacian(Foam::volVectorField& U) {
    return Foam::fvVectorMatrix(
        Foam::fvm::laplacian(Foam::dimensionedScalar("nu", Foam::dimViscosity, 1.0), U));
}

/// Puts the boundary's contribution to the diagonal where a solver expects it.
template <class Type>
BoxOperator read(const Foam::fvMatrix<Type>& matrix, const BoxCells& box) {
    // fvMatrix keeps it apart, per patch and component, until it is solved.
    Foam::lduMatrix whole(matrix);
    Foam::scalarField& diagonal = whole.diag();
    forAll(matrix.internalCoeffs(), patch) {
        const Foam::labelUList& cells = whole.lduAddr().patchAddr(patch);
        const Foam::scalarField share(matrix.internalCoeffs()[patch].component(0));
        forAll(cells, face) diagonal[cells[face]] += share[face];
    }
    const Foam::FieldField<Foam::Field, Foam::scalar> beyond(matrix.boundaryCoeffs().component(0));
    return exact_operator({whole, beyond, matrix.psi().boundaryField().scalarInterfaces()}, box);
}

template <class Type>
BoxOperator lasting_operator(VolField<Type>& field, const BoxCells& box, Held allowed) {
    // All ranks must come to the same verdict, since all take part in what follows.
    demand(box.ranks, switching_condition(field));
    const auto matrix = laplacian(field);
    demand(box.ranks, inhomogeneous_condition(matrix, allowed));
    return read(matrix, box);
}

}  // namespace

BoxOperator laplacian_operator(Foam::volScalarField& p, const BoxCells& box) {
    return lasting_operator(p, box, Held::anything);
}

BoxOperator laplacian_operator(Foam::volVectorField& U, const BoxCells& box) {
    return lasting_operator(U, box, Held::anything);
}

BoxOperator homogeneous_laplacian(Foam::volScalarField& p, const BoxCells& box) {
    return lasting_operator(p, box, Held::nothing);
}

BoxOperator laplacian_with_values(Foam::volVectorField& U, const BoxCells& box) {
    return lasting_operator(U, box, Held::values);
}

}  // namespace turbidite
