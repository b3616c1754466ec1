// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Interpolation between cell centres, linear along every axis, for probes. Valid C++17.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "coupler/rigid/vec3.hpp"
#include "fluid_adapter/multiplier/cell_grid.hpp"

namespace turbidite {

struct StencilEntry {
    int i = 0, j = 0, k = 0;  ///< a cell of the grid
    double weight = 0.0;
};

/// The two layers of an axis around a coordinate, and the weight of the second.
struct AxisStencil {
    std::array<int, 2> layer{};
    double upper = 0.0;

    double weight(int end) const { return end == 0 ? 1.0 - upper : upper; }
};

/// Between a side that is not cyclic and the centres next to it, the values of these centres.
inline AxisStencil axis_stencil(const CellGrid& grid, int axis, double coordinate) {
    const int below = grid.layer_below(axis, coordinate), most = grid.counts[axis] - 1;
    const bool inside = grid.cyclic(axis) || (below >= 0 && below < most);
    AxisStencil stencil;
    for (int end = 0; end < 2; ++end)
        stencil.layer[end] =
            grid.cyclic(axis) ? grid.wrapped(axis, below + end) : std::clamp(below + end, 0, most);
    if (inside)
        stencil.upper = (coordinate - grid.centre(axis, below)) /
                        (grid.centre(axis, below + 1) - grid.centre(axis, below));
    return stencil;
}

/// The four cells around a point, in space eight, and their weights, which add up to 1.
inline std::vector<StencilEntry> linear_stencil(const CellGrid& grid, const Vec3& point) {
    const AxisStencil x = axis_stencil(grid, 0, point[0]), y = axis_stencil(grid, 1, point[1]);
    AxisStencil z;
    if (grid.dimension == 3) z = axis_stencil(grid, 2, point[2]);
    std::vector<StencilEntry> stencil;
    for (int end = 0; end < 1 << grid.dimension; ++end) {
        const int a = end % 2, b = end / 2 % 2, c = end / 4;
        stencil.push_back(
            {x.layer[a], y.layer[b], z.layer[c], x.weight(a) * y.weight(b) * z.weight(c)});
    }
    return stencil;
}

}  // namespace turbidite
