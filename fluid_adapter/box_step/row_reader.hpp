// SPDX-License-Identifier: GPL-2.0-or-later
//
// The rows of a field one after the other, with two values beyond each end and two rows beyond the
// first and the last, so that no stencil knows about sides. Beyond a side half a cell away lies the
// mirror image of the inside (separable_operator.hpp), or the other end.
//
// Rows are copies: the caller may change the field behind the reader. Valid C++17.
#pragma once

#include <array>
#include <vector>

#include "fluid_adapter/linear_solvers/separable_solve.hpp"

namespace turbidite {

class RowReader {
 public:
    static constexpr int beyond = 2;

    explicit RowReader(const PlaneOperator& plane);

    /// From the first row again; `values`: rows of x.cells values, one after the other.
    void begin(const double* values);

    /// Row j, -beyond <= j < y.cells + beyond: values [-beyond, x.cells + beyond). Rows are asked
    /// for in ascending order; the last `kept` remain valid.
    const double* row(int j);

    /// Fills the values beyond the ends of a row.
    void extend(double* row) const;

    static constexpr int kept = 4;
    static constexpr int padding = 2 * beyond;

 private:
    void load(int j);
    const double* source(int j, double& factor) const;

    PlaneOperator plane_;
    const double* values_ = nullptr;
    int loaded_ = 0;               // the last row
    std::vector<double> borders_;  // the first two and the last two rows
    std::vector<double> slots_;
};

/// 1 or -1: what a mirror image beyond this end is multiplied with.
double mirrored(End end);

}  // namespace turbidite
