// SPDX-License-Identifier: GPL-2.0-or-later
//
// The transforms of a layer (separable_operator.hpp) along x and, in space, along z; they make of
// cell i + nx k the mode of x and z with the same number. Valid C++17.
#pragma once

#include <memory>
#include <vector>

#include "fluid_adapter/linear_solvers/transform.hpp"

namespace turbidite {

class LayerTransform {
 public:
    explicit LayerTransform(const SeparableOperator& grid);

    /// How many layers are transformed together, except at an end: rows go in pairs.
    int together() const { return rows_ % 2 == 0 ? 1 : 2; }

    /// Transforms consecutive layers in place.
    void forward(double* layers, int count);
    void backward(double* layers, int count);

    /// Factor by which a forward and a backward transform together multiply.
    double normalisation() const;

 private:
    static constexpr int block = 8;  // columns of a layer that are copied together: a line of cache

    template <class Transform>
    void along_z(double* layers, int count, Transform transform);

    std::size_t columns_;
    int rows_;  // of a layer
    RowTransform x_;
    std::unique_ptr<RowTransform> z_;  // null in the plane
    std::vector<double> lines_;        // columns of a layer, each contiguous
};

}  // namespace turbidite
