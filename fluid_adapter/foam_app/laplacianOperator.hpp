// SPDX-License-Identifier: GPL-3.0-or-later
//
// The Laplacian of a field with its boundary conditions, read once from OpenFOAM's matrix
// (foam_solver/boxOperator.hpp). So it must stay what it is: the conditions are ones that never
// switch between holding a value and a gradient. Every function is called by all ranks.
#pragma once

#include <volFields.H>

#include "fluid_adapter/foam_solver/boxOperator.hpp"

namespace turbidite {

/// Throw DoesNotFit, naming the condition and the patch, or what of the matrix is not separable.
BoxOperator laplacian_operator(Foam::volScalarField& p, const BoxCells& box);
BoxOperator laplacian_operator(Foam::volVectorField& U, const BoxCells& box);

/// The same for conditions that are homogeneous too: what is held is zero.
BoxOperator homogeneous_laplacian(Foam::volScalarField& p, const BoxCells& box);
BoxOperator homogeneous_laplacian(Foam::volVectorField& U, const BoxCells& box);

}  // namespace turbidite
