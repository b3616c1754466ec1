// SPDX-License-Identifier: GPL-2.0-or-later
//
// Solves (alpha - beta laplacian) x = f on a grid directly, uniform along x and z, with layers (the
// values of one y, separable_operator.hpp) of any heights: f is transformed along x and z, each
// mode is solved along y, and the result is transformed back. The work is two transforms and one
// elimination per layer, whatever alpha and beta are.
//
// The Laplacian is that of separable_operator.hpp along all axes, per unit volume. If no end is
// dirichlet and alpha = 0, x is determined up to a constant: the mean of f over the volume is
// subtracted, and x has zero mean. Valid C++17.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "fluid_adapter/linear_solvers/column_solve.hpp"
#include "fluid_adapter/linear_solvers/layer_transform.hpp"
#include "fluid_adapter/linear_solvers/pencils.hpp"

namespace turbidite {

class SeparableSolve {
 public:
    /// On one rank.
    explicit SeparableSolve(const SeparableOperator& grid);

    /// On the ranks that share the pencils.
    SeparableSolve(const SeparableOperator& grid, std::unique_ptr<Pencils> pencils);

    /// To be called before the first solve, and whenever alpha or beta change.
    void factorise(const Helmholtz& problem);

    /// f before a solve and x after it: this rank's layers.
    double* values() { return pencils_->rows(); }

    /// Returns the mean subtracted from f, zero where x is unique; the same on every rank.
    double solve();

    /// The same for a caller that produces f and consumes x layer by layer: `fill(j)` is called
    /// before layer j is read, in ascending order; `take(j)` once it is complete, in descending
    /// order. On one rank a layer is filled, transformed and eliminated while it is in cache.
    using LayerWork = std::function<void(int)>;
    double solve(const LayerWork& fill, const LayerWork& take);

 private:
    double* layer(int j) { return values() + static_cast<std::size_t>(j) * cells_of_layer_; }
    template <class Done>
    void forward(const LayerWork& fill, Done done);
    template <class Ready>
    void backward(Ready ready, const LayerWork& take);

    std::unique_ptr<Pencils> pencils_;
    int cells_of_layer_;
    LayerTransform transform_;
    ColumnSolve columns_;
    bool zero_mode_;               // no end is dirichlet
    bool free_constants_ = false;  // also alpha = 0
};

}  // namespace turbidite
