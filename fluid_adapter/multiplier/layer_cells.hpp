// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The cells of a rank in space: whole layers of the cells of one y (box_step/box_layers.hpp). Cell
// (i, j, k) of the grid has the local index i + nx (k + nz (j - first)). Valid C++17.
#pragma once

#include "fluid_adapter/multiplier/cell_grid.hpp"

namespace turbidite {

struct LayerCells {
    const CellGrid* grid;
    int first, count;  ///< layers of this rank

    bool owns(int j) const { return j >= first && j < first + count; }
    int cell(int i, int j, int k) const {
        return i + grid->counts[0] * (k + grid->counts[2] * (j - first));
    }
    std::size_t cells() const {
        return static_cast<std::size_t>(grid->counts[0]) * grid->counts[2] * count;
    }
};

}  // namespace turbidite
