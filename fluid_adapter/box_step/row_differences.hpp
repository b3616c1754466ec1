// SPDX-License-Identifier: GPL-2.0-or-later
//
// Differences of a field in the rows of a box, of equal or of different heights (row_heights.hpp).
// Valid C++17.
#pragma once

#include "fluid_adapter/box_step/box_layers.hpp"
#include "fluid_adapter/box_step/row_reader.hpp"

namespace turbidite {

struct RowDifferences {
    const BoxLayers& layers;

    /// out = share L u of row k of layer j
    void laplacian(int j, int k, double share, RowReader& u, double* out) const;

    /// out = in - step G p along an axis, of row k of layer j; out may be in
    void correct(int axis, int j, int k, double step, RowReader& p, const double* in,
                 double* out) const;
};

}  // namespace turbidite
