// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_adapter/linear_solvers/layer_transform.hpp"

#include <algorithm>

namespace turbidite {

LayerTransform::LayerTransform(const SeparableOperator& grid)
    : columns_(grid.x.cells), rows_(grid.z.cells), x_(grid.x) {
    if (!grid.in_space()) return;
    z_ = std::make_unique<RowTransform>(grid.z);
    lines_.resize(static_cast<std::size_t>(block) * rows_);
}

double LayerTransform::normalisation() const {
    return z_ ? x_.normalisation() * z_->normalisation() : x_.normalisation();
}

void LayerTransform::forward(double* layers, int count) {
    const int rows = count * rows_;
    for (int r = 0; r < rows; r += 2)
        x_.forward(layers + r * columns_, r + 1 < rows ? layers + (r + 1) * columns_ : nullptr);
    if (z_) along_z(layers, count, [&](double* a, double* b) { z_->forward(a, b); });
}

void LayerTransform::backward(double* layers, int count) {
    if (z_) along_z(layers, count, [&](double* a, double* b) { z_->backward(a, b); });
    // Pairs from the last row on: of an odd number of rows the first has no partner here, in
    // `forward` the last.
    for (int r = count * rows_ - 1; r >= 0; r -= 2)
        x_.backward(layers + r * columns_, r > 0 ? layers + (r - 1) * columns_ : nullptr);
}

/// transform(first, second) for all pairs of columns; `second` may be null.
template <class Transform>
void LayerTransform::along_z(double* layers, int count, Transform transform) {
    // A block of columns is copied to contiguous lines and back, each line of cache once.
    for (double* layer = layers; layer < layers + count * rows_ * columns_;
         layer += rows_ * columns_)
        for (std::size_t i = 0; i < columns_; i += block) {
            const int width = static_cast<int>(std::min<std::size_t>(block, columns_ - i));
            for (int k = 0; k < rows_; ++k)
                for (int c = 0; c < width; ++c) lines_[c * rows_ + k] = layer[k * columns_ + i + c];
            for (int c = 0; c < width; c += 2) {
                double* first = lines_.data() + static_cast<std::size_t>(c) * rows_;
                transform(first, c + 1 < width ? first + rows_ : nullptr);
            }
            for (int k = 0; k < rows_; ++k)
                for (int c = 0; c < width; ++c) layer[k * columns_ + i + c] = lines_[c * rows_ + k];
        }
}

}  // namespace turbidite
