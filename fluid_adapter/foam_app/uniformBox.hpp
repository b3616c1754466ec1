// SPDX-License-Identifier: GPL-3.0-or-later
//
// Is this mesh with these boundary conditions a separable problem? It is when one layer of equal
// cells, numbered i + nx j, fills a box whose four sides are one patch each, and when every side
// holds one of
//
//     zeroGradient                  neumann
//     fixedValue 0, noSlip          dirichlet
//     cyclic, with the side across  periodic
//
// All of it is read from the mesh and the field, not from the case's settings.
#pragma once

#include <volFields.H>

#include <array>
#include <stdexcept>

#include "fluid_adapter/linear_solvers/separable_solve.hpp"

namespace turbidite {

/// Says what of the mesh or the conditions does not fit.
struct NotSeparable : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct UniformBox {
    std::array<int, 2> cells{};
    std::array<double, 2> spacing{};       ///< [m]
    std::array<Foam::label, 4> patches{};  ///< left, right, bottom, top
};

/// Throws NotSeparable.
UniformBox uniform_box(const Foam::fvMesh& mesh);

/// The Laplacian with the conditions of `field`; throws NotSeparable. For scalars and vectors.
template <class Type>
PlaneOperator plane_operator(
    const Foam::GeometricField<Type, Foam::fvPatchField, Foam::volMesh>& field);

}  // namespace turbidite
