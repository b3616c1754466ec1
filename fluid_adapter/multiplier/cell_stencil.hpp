// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Bilinear interpolation between cell centres, for probes. Valid C++17.
#pragma once

#include <algorithm>
#include <array>

#include "fluid_adapter/multiplier/cell_grid.hpp"

namespace turbidite {

struct StencilEntry {
    int i = 0, j = 0;  ///< a cell of the grid
    double weight = 0.0;
};

/// The four cells around a point and their weights, which add up to 1. Between a side that is not
/// cyclic and the centres next to it, the values of these centres.
inline std::array<StencilEntry, 4> bilinear_stencil(const CellGrid& grid,
                                                    const std::array<double, 2>& point) {
    int cell[2][2];
    double weight[2][2];
    for (int axis = 0; axis < 2; ++axis) {
        const int below = grid.layer_below(axis, point[axis]), most = grid.counts[axis] - 1;
        const bool inside = grid.cyclic(axis) || (below >= 0 && below < most);
        const double share = !inside
                                 ? 0.0
                                 : (point[axis] - grid.centre(axis, below)) /
                                       (grid.centre(axis, below + 1) - grid.centre(axis, below));
        for (int k = 0; k < 2; ++k) {
            const int layer = below + k;
            cell[axis][k] =
                grid.cyclic(axis) ? grid.wrapped(axis, layer) : std::clamp(layer, 0, most);
            weight[axis][k] = k == 0 ? 1.0 - share : share;
        }
    }
    std::array<StencilEntry, 4> stencil;
    for (int k = 0; k < 4; ++k)
        stencil[k] = {cell[0][k % 2], cell[1][k / 2], weight[0][k % 2] * weight[1][k / 2]};
    return stencil;
}

}  // namespace turbidite
