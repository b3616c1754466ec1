// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_adapter/linear_solvers/transform.hpp"

#include <algorithm>

#include "fluid_adapter/linear_solvers/fourier_rows.hpp"

namespace turbidite {

RowTransform::RowTransform(const AxisOperator& axis)
    : kind_(make_row_kind(axis)),
      absent_(axis.cells, 0.0),
      normalisation_(axis.periodic() ? axis.cells : 2.0 * axis.cells) {}

RowTransform::~RowTransform() = default;

// Set to zero before each call. Transforms are not normalised, and the rounding that one row of a
// pair leaves in the other would grow from solve to solve.
double* RowTransform::absent_row() {
    std::fill(absent_.begin(), absent_.end(), 0.0);
    return absent_.data();
}

void RowTransform::forward(double* first, double* second) {
    kind_->forward(first, second ? second : absent_row());
}

void RowTransform::backward(double* first, double* second) {
    kind_->backward(first, second ? second : absent_row());
}

}  // namespace turbidite
