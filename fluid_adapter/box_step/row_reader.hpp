// SPDX-License-Identifier: GPL-2.0-or-later
//
// Reads the rows of a rank's field in order, each extended by two values at both ends, with two
// more rows below the first and above the last, so that stencils need not know about sides or
// ranks. Beyond a side lies the mirror image of the inside (the side is half a cell from the
// centres, separable_operator.hpp); elsewhere, what box_rows.hpp says.
//
// Rows are copies: the caller may overwrite the field behind the reader. Valid C++17.
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

    /// Restarts at the first row. `values`: the rank's rows of x.cells values, contiguous. Called
    /// by every rank.
    void begin(const double* values);

    /// Row j, -beyond <= j < rows + beyond: values [-beyond, x.cells + beyond). Rows must be
    /// requested in ascending order; the last `kept` rows remain valid.
    const double* row(int j);

    /// Fills the values beyond both ends of a row.
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
    int loaded_ = 0;                       // index of the last row read
    std::vector<double> edges_, outside_;  // as in box_rows.hpp
    std::vector<double> slots_;
};

/// Factor of the mirror image beyond this end: 1 or -1.
double mirrored(End end);

}  // namespace turbidite
