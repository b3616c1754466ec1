// SPDX-License-Identifier: GPL-2.0-or-later
//
// Reads the rows of a rank's field in order, each extended by two values at both ends, with two
// more rows below the first and above the last, so that stencils need not know about sides or
// ranks. Beyond a side lies the mirror image of the inside (the side is half a cell from the
// centres, separable_operator.hpp), shifted where the side prescribes a value (side_values.hpp);
// elsewhere, what box_rows.hpp says.
//
// Rows are copies: the caller may overwrite the field behind the reader. Valid C++17.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "fluid_adapter/box_step/box_rows.hpp"
#include "fluid_adapter/box_step/side_values.hpp"

namespace turbidite {

class RowReader {
 public:
    static constexpr int beyond = BoxRows::beyond;

    /// `rows` must outlive it, and so must the values on the sides; null: none are prescribed.
    RowReader(const SeparableOperator& plane, BoxRows& rows, const SideValues* sides = nullptr);

    /// Restarts at the first row. `values`: the rank's rows of x.cells values, contiguous. Called
    /// by every rank.
    void begin(const double* values);

    /// The same for a field that is to be changed first: `change(j)` changes row j of `values` in
    /// place, once, before it is read. A pass that changes a field and one that reads it become one
    /// if the rows are read to the end.
    using Change = std::function<void(int)>;
    void begin(const double* values, Change change);

    /// Row j, -beyond <= j < rows + beyond: values [-beyond, x.cells + beyond). Rows must be
    /// requested in ascending order; the last `kept` rows remain valid.
    const double* row(int j);

    /// Fills the values beyond both ends of row j. Rows beyond the rank's own take the sides to be
    /// at rest: no stencil reaches into their corners.
    void extend(double* row, int j) const;

    static constexpr int kept = 4;
    static constexpr int padding = 2 * beyond;

 private:
    bool at_edge(int j) const { return j < beyond || j >= rows_.count() - beyond; }
    void load(int j);
    void look_outside(const double* values);
    void mirror(int from, int to, int side);
    double on_side(int side, int j) const;

    SeparableOperator plane_;
    BoxRows& rows_;
    const SideValues* sides_;
    const double* values_ = nullptr;
    Change change_;                        // of rows that are not at the edges; may be empty
    int loaded_ = 0;                       // index of the last row read
    std::vector<double> edges_, outside_;  // as in box_rows.hpp
    std::vector<double> slots_;
};

/// Factor of the mirror image beyond this end: 1 or -1.
double mirrored(End end);

}  // namespace turbidite
