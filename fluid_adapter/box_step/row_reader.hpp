// SPDX-License-Identifier: GPL-2.0-or-later
//
// A rank's rows of a field one after the other, with two values beyond each end and two rows beyond
// the first and the last, so that no stencil knows about sides or ranks. Beyond a side half a cell
// away lies the mirror image of the inside (separable_operator.hpp); elsewhere what box_rows.hpp
// says.
//
// Rows are copies: the caller may change the field behind the reader. Valid C++17.
#pragma once

#include <array>
#include <vector>

#include "fluid_adapter/box_step/box_rows.hpp"

namespace turbidite {

class RowReader {
 public:
    static constexpr int beyond = BoxRows::beyond;

    /// `rows` must outlive it.
    RowReader(const PlaneOperator& plane, BoxRows& rows);

    /// From the first row again; `values`: the rank's rows of x.cells values, one after the other.
    /// Every rank calls it.
    void begin(const double* values);

    /// Row j, -beyond <= j < rows + beyond: values [-beyond, x.cells + beyond). Rows are asked
    /// for in ascending order; the last `kept` remain valid.
    const double* row(int j);

    /// Fills the values beyond the ends of a row.
    void extend(double* row) const;

    static constexpr int kept = 4;
    static constexpr int padding = 2 * beyond;

 private:
    void load(int j);
    void look_outside(const double* values);
    void mirror(int from, int to, End end);

    PlaneOperator plane_;
    BoxRows& rows_;
    const double* values_ = nullptr;
    int loaded_ = 0;                       // the last row
    std::vector<double> edges_, outside_;  // as in box_rows.hpp
    std::vector<double> slots_;
};

/// 1 or -1: what a mirror image beyond this end is multiplied with.
double mirrored(End end);

}  // namespace turbidite
