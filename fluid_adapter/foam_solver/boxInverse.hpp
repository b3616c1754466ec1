// SPDX-License-Identifier: GPL-3.0-or-later
//
// x = A^-1 r of a separable operator, with its transforms and factorisation kept between calls.
//
// A reference makes A = L + delta e e^T, e the unit vector of its cell and L with constants in its
// kernel. Summing the rows gives delta x_ref = sum r, and then L x = r - (sum r) e has a solution
// that this value at the reference makes unique. Without a reference and constants free, the mean
// of r is taken off and x has zero mean.
#pragma once

#include <scalarField.H>

#include <memory>

#include "fluid_adapter/foam_solver/boxOperator.hpp"
#include "fluid_adapter/ranks/cell_rows.hpp"

namespace turbidite {

class BoxInverse {
 public:
    /// Both are kept by reference.
    BoxInverse(const BoxCells& box, CellRows& rows) : box_(box), rows_(rows) {}

    /// Makes anew what differs from the operator before. Called by all ranks, like `apply`.
    void set(const BoxOperator& to);

    /// r and x in the mesh's order of cells; they may be the same field.
    void apply(const Foam::solveScalarField& r, Foam::solveScalarField& x);

 private:
    double* reference_value() const;

    const BoxCells& box_;
    CellRows& rows_;
    BoxOperator operator_;
    std::unique_ptr<SeparableSolve> solve_;
};

}  // namespace turbidite
