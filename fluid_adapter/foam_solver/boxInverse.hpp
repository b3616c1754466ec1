// SPDX-License-Identifier: GPL-3.0-or-later
//
// x = A^-1 r for a separable operator; its transforms and factorisation are kept between calls.
//
// With a reference, A = L + delta e e^T, where e is the unit vector of its cell and L has constants
// in its kernel. Summing all equations gives delta x_ref = sum r, and then L x = r - (sum r) e has
// a solution, made unique by this value at the reference. If constants are free and there is no
// reference, the mean of r is subtracted and x has zero mean.
#pragma once

#include <scalarField.H>

#include <memory>

#include "fluid_adapter/foam_solver/boxOperator.hpp"
#include "fluid_adapter/ranks/cell_rows.hpp"

namespace turbidite {

class BoxInverse {
 public:
    /// Keeps references to both.
    BoxInverse(const BoxCells& box, CellRows& rows) : box_(box), rows_(rows) {}

    /// Recomputes what depends on the parts of the operator that have changed. Called by all ranks,
    /// as is `apply`.
    void set(const BoxOperator& to);

    /// r and x are in the mesh's order of cells, and may be the same field.
    void apply(const Foam::solveScalarField& r, Foam::solveScalarField& x);

 private:
    double* reference_value() const;
    void divide_by_height(double* values) const;

    const BoxCells& box_;
    CellRows& rows_;
    BoxOperator operator_;
    std::unique_ptr<SeparableSolve> solve_;
};

}  // namespace turbidite
