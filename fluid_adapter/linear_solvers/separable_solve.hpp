// SPDX-License-Identifier: GPL-2.0-or-later
//
// (alpha - beta laplacian) x = f on a uniform grid of nx x ny cells, exactly: f is transformed
// along x, each mode solved along y, and transformed back. The work is 2 transforms of nx values
// and one elimination per row, whatever alpha and beta are.
//
// The Laplacian is separable_operator.hpp's along both axes, per unit volume. Where no end is
// dirichlet and alpha = 0, constants are free: the mean of f is taken off, and x has zero mean.
// Valid C++17.
#pragma once

#include <memory>

#include "fluid_adapter/linear_solvers/column_solve.hpp"
#include "fluid_adapter/linear_solvers/pencils.hpp"
#include "fluid_adapter/linear_solvers/transform.hpp"

namespace turbidite {

struct PlaneOperator {
    AxisOperator x, y;
};

class SeparableSolve {
 public:
    /// On one rank.
    explicit SeparableSolve(const PlaneOperator& plane);

    /// On the ranks that share the pencils.
    SeparableSolve(const PlaneOperator& plane, std::unique_ptr<Pencils> pencils);

    /// To be called before the first solve and when alpha or beta change.
    void factorise(const Helmholtz& problem);

    /// f before a solve and x after it: this rank's complete rows of nx values.
    double* values() { return pencils_->rows(); }

    /// Returns the mean that was taken off f, zero where constants are not free; on every rank.
    double solve();

 private:
    std::unique_ptr<Pencils> pencils_;
    RowTransform transform_;
    ColumnSolve columns_;
    bool zero_mode_;               // no end is dirichlet
    bool free_constants_ = false;  // and alpha = 0
};

}  // namespace turbidite
