// SPDX-License-Identifier: GPL-3.0-or-later
//
// Is this mesh with these boundary conditions a separable problem? It is when one layer of equal
// cells fills a box, in any numbering and on any ranks, whose four sides are one patch each, and
// when every side holds one of
//
//     zeroGradient                  neumann
//     fixedValue 0, noSlip          dirichlet
//     cyclic, with the side across  periodic
//
// All of it is read from the mesh and the field, not from the case's settings. On several ranks a
// side is what all of them have of its patch, and all come to the same verdict. Every function here
// is called by all ranks.
#pragma once

#include <volFields.H>

#include <array>
#include <stdexcept>
#include <vector>

#include "fluid_adapter/linear_solvers/separable_solve.hpp"
#include "fluid_adapter/ranks/cell_rows.hpp"

namespace turbidite {

/// Says what of the mesh or the conditions does not fit.
struct NotSeparable : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct UniformBox {
    std::array<int, 2> cells{};            ///< of all ranks
    std::array<double, 2> spacing{};       ///< [m]
    std::array<Foam::label, 4> patches{};  ///< left, right, bottom, top
    std::vector<int> numbers;              ///< i + nx j of each cell of this rank
};

/// Throws NotSeparable.
UniformBox uniform_box(const Foam::fvMesh& mesh);

/// The Laplacian with the conditions of `field`; throws NotSeparable. For scalars and vectors.
template <class Type>
PlaneOperator plane_operator(
    const Foam::GeometricField<Type, Foam::fvPatchField, Foam::volMesh>& field,
    const UniformBox& box);

/// Between this rank's cells and rows of the box.
CellRows cell_rows(const RankGroup& ranks, const UniformBox& box);

}  // namespace turbidite
