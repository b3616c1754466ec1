// SPDX-License-Identifier: GPL-3.0-or-later
//
// The separable operator of a matrix on a box of cells. For cell a with neighbours b the matrix is
//
//     (A x)_a = s (d_a x_a - sum_b c_ab x_b)        s  its sign; -1 for OpenFOAM's Laplacian
//
// and the excess of the diagonal over the neighbours,
//
//     d_a - sum_b c_ab = alpha + 2 c (per side that holds a value) + delta (one cell)
//
// determines the rest: alpha of a time derivative or a sink, which sides hold a value, and the cell
// at which fvMatrix::setReference made the matrix regular. Separable means that c is one number per
// axis, and that nothing acts apart from the matrix but the right-hand side.
//
// Rows of cells may have different heights (a mesh that is graded along y, without cyclic sides
// there). With heights g_j over that of most rows, c along x is g_j c_x, c along y is
// 2 c_y/(g_j + g_{j+1}), and equations are those of the operator times g_j. Both functions are
// called by all ranks and give the same result on all.
#pragma once

#include <lduMatrix.H>

#include "fluid_adapter/foam_solver/boxCells.hpp"
#include "fluid_adapter/linear_solvers/separable_solve.hpp"

namespace turbidite {

/// The matrix as its solver sees it: the boundary's contribution to the diagonal is included.
struct SolverMatrix {
    const Foam::lduMatrix& matrix;
    const Foam::FieldField<Foam::Field, Foam::scalar>& boundary;
    const Foam::lduInterfaceFieldPtrsList& interfaces;
};

struct BoxOperator {
    double sign = 1.0;        ///< s
    SeparableOperator plane;  ///< spacing 1 along x and sqrt(c_x/c_y) along y, times g_j
    Helmholtz problem;        ///< alpha, and beta = c_x
    int reference = -1;       ///< place of the cell with delta; -1: none
    double stiffening = 0;    ///< delta

    /// g_j of row j.
    double height(int j) const { return plane.y.size(j) / plane.y.spacing; }

    /// Constants are in the kernel of the operator without the reference.
    bool floating() const {
        return problem.alpha == 0.0 && plane.x.has_zero_mode() && plane.y.has_zero_mode();
    }
};

/// Relative deviation allowed between the coefficients of an axis; mesh points are written with 10
/// digits. The solver corrects the resulting error.
constexpr double coefficient_tolerance = 1e-5;

/// Throws DoesNotFit, with the coefficient and the cell, unless the matrix is separable.
BoxOperator exact_operator(const SolverMatrix& system, const BoxCells& box);

/// The separable operator with the mean coefficients of the matrix; positive definite if s A is.
/// Throws DoesNotFit if cyclic patches do not close the box, or if the coefficients have no common
/// sign.
BoxOperator nearest_operator(const SolverMatrix& system, const BoxCells& box);

}  // namespace turbidite
