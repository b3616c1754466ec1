// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Laplacian of a field with its boundary conditions, read once from OpenFOAM's matrix
// (foam_solver/boxOperator.hpp). It must therefore be constant: only conditions that never switch
// between holding a value and a gradient are allowed. Every function is called by all ranks.
#pragma once

#include <volFields.H>

#include "fluid_adapter/foam_solver/boxOperator.hpp"

namespace turbidite {

/// Throw DoesNotFit, naming the condition and the patch, or what in the matrix is not separable.
BoxOperator laplacian_operator(Foam::volScalarField& p, const BoxCells& box);
BoxOperator laplacian_operator(Foam::volVectorField& U, const BoxCells& box);

/// The same for homogeneous conditions only: the values or gradients held are zero.
BoxOperator homogeneous_laplacian(Foam::volScalarField& p, const BoxCells& box);

/// The same where only the gradients held have to be zero.
BoxOperator laplacian_with_values(Foam::volVectorField& U, const BoxCells& box);

}  // namespace turbidite
