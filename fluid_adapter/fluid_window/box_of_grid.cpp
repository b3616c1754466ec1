// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/fluid_window/box_of_grid.hpp"

namespace turbidite {
namespace {

End velocity_end(Side side) {
    // A wall or an inflow holds u; a free side has no gradient of it.
    return side == Side::cyclic ? End::periodic
           : side == Side::wall ? End::dirichlet
                                : End::neumann;
}

End pressure_end(Side side) {
    // The other way round: p = 0 on a free side, and no gradient where u is held.
    return side == Side::cyclic ? End::periodic
           : side == Side::wall ? End::neumann
                                : End::dirichlet;
}

AxisOperator axis_of(const CellGrid& grid, int axis, End (*end)(Side)) {
    AxisOperator of{grid.counts[axis], grid.spacing[axis], end(grid.sides[axis][0]),
                    end(grid.sides[axis][1])};
    if (!grid.stretched(axis)) return of;
    for (int j = 0; j < of.cells; ++j) of.sizes.push_back(grid.size(axis, j));
    // Of a stretched axis that of its equal cells, which begin at the bottom.
    of.spacing = of.sizes.front();
    return of;
}

SeparableOperator operator_of(const CellGrid& grid, End (*end)(Side)) {
    SeparableOperator all{axis_of(grid, 0, end), axis_of(grid, 1, end)};
    if (grid.dimension == 3) all.z = axis_of(grid, 2, end);
    return all;
}

}  // namespace

BoxFluid box_of(const CellGrid& grid) {
    BoxFluid fluid;
    fluid.velocity = operator_of(grid, velocity_end);
    fluid.pressure = operator_of(grid, pressure_end);
    return fluid;
}

VelocityOnSides sides_at_rest(const CellGrid& grid) {
    const std::size_t nx = grid.counts[0], ny = grid.counts[1], nz = grid.counts[2];
    const std::size_t sizes[] = {ny * nz, nx * nz, nx * ny};
    VelocityOnSides sides;
    for (SideValues& values : sides)
        for (std::size_t side = 0; side < values.size(); ++side)
            values[side].assign(sizes[side / 2], 0.0);
    return sides;
}

}  // namespace turbidite
