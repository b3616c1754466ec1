// SPDX-License-Identifier: GPL-2.0-or-later
//
// Solves (alpha - beta laplacian) x = f on a grid of nx x ny cells directly, uniform along x,
// with rows of any heights: f is transformed along x, each mode is solved along y, and the result
// is transformed back. The work is two transforms of nx values and one elimination per row (the nx
// values of one y), whatever alpha and beta are.
//
// The Laplacian is that of separable_operator.hpp along both axes, per unit volume. If no end is
// dirichlet and alpha = 0, x is determined up to a constant: the mean of f over the volume is
// subtracted, and x has zero mean. Valid C++17.
#pragma once

#include <cstddef>
#include <functional>
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

    /// To be called before the first solve, and whenever alpha or beta change.
    void factorise(const Helmholtz& problem);

    /// f before a solve and x after it: this rank's complete rows of nx values.
    double* values() { return pencils_->rows(); }

    /// Returns the mean subtracted from f, zero where x is unique; the same on every rank.
    double solve();

    /// The same for a caller that produces f and consumes x row by row: `fill(j)` is called before
    /// row j is read, in ascending order; `take(j)` once it is complete, in descending order. On
    /// one rank a row is filled, transformed and eliminated while it is in cache.
    using RowWork = std::function<void(int)>;
    double solve(const RowWork& fill, const RowWork& take);

 private:
    double* row(int j) { return values() + static_cast<std::size_t>(j) * columns_of_grid_; }
    template <class Done>
    void forward(const RowWork& fill, Done done);
    template <class Ready>
    void backward(Ready ready, const RowWork& take);

    std::unique_ptr<Pencils> pencils_;
    int columns_of_grid_;
    RowTransform transform_;
    ColumnSolve columns_;
    bool zero_mode_;               // no end is dirichlet
    bool free_constants_ = false;  // also alpha = 0
};

}  // namespace turbidite
