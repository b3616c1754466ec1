// SPDX-License-Identifier: GPL-3.0-or-later
//
// The separable operator of a matrix on a box of cells. For cell a with neighbours b the matrix is
//
//     (A x)_a = s (d_a x_a - sum_b c_ab x_b)        s  its sign; -1 for OpenFOAM's Laplacian
//
// and what the diagonal has beyond its neighbours,
//
//     d_a - sum_b c_ab = alpha + 2 c (per side that holds a value) + delta (one cell)
//
// tells the rest: alpha of a time derivative or a sink, which sides hold a value, and the cell that
// fvMatrix::setReference made regular. Separable means that c is one number per axis and that the
// right-hand side is all there is. Both functions are called by all ranks and give all the same.
#pragma once

#include <lduMatrix.H>

#include "fluid_adapter/foam_solver/boxCells.hpp"
#include "fluid_adapter/linear_solvers/separable_solve.hpp"

namespace turbidite {

/// The matrix as its solver sees it: the boundary's share of the diagonal is in the diagonal.
struct SolverMatrix {
    const Foam::lduMatrix& matrix;
    const Foam::FieldField<Foam::Field, Foam::scalar>& boundary;
    const Foam::lduInterfaceFieldPtrsList& interfaces;
};

struct BoxOperator {
    double sign = 1.0;      ///< s
    PlaneOperator plane;    ///< spacing 1 along x and sqrt(c_x/c_y) along y
    Helmholtz problem;      ///< alpha, and beta = c_x
    int reference = -1;     ///< place of the cell with a delta, or none
    double stiffening = 0;  ///< delta

    /// Constants are in the kernel of what is left without the reference.
    bool floating() const {
        return problem.alpha == 0.0 && plane.x.has_zero_mode() && plane.y.has_zero_mode();
    }
};

/// Coefficients may differ from their axis's by this share; mesh points are written with 10 digits.
/// The solver corrects what this leaves.
constexpr double coefficient_tolerance = 1e-5;

/// Throws DoesNotFit, with the coefficient and the cell, unless the matrix is separable.
BoxOperator exact_operator(const SolverMatrix& system, const BoxCells& box);

/// The separable operator with the matrix's mean coefficients. Positive definite where s A is.
/// Throws DoesNotFit where cyclic patches do not close the box, and where the coefficients have no
/// common sign.
BoxOperator nearest_operator(const SolverMatrix& system, const BoxCells& box);

}  // namespace turbidite
