// SPDX-License-Identifier: GPL-2.0-or-later
//
// Differences between the rows of a field, of equal or of different heights (row_heights.hpp).
// Valid C++17.
#pragma once

#include "fluid_adapter/box_step/row_heights.hpp"
#include "fluid_adapter/box_step/row_reader.hpp"

namespace turbidite {

struct RowDifferences {
    int nx;
    double hx;
    const RowHeights& heights;

    /// out = share L u of row j
    void laplacian(int j, double share, RowReader& u, double* out) const;

    /// out = in - step G p along y, of row j; out may be in
    void correct_across(int j, double step, RowReader& p, const double* in, double* out) const;
};

}  // namespace turbidite
