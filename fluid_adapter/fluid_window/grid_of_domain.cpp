// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/fluid_window/grid_of_domain.hpp"

namespace turbidite {
namespace {

Side side_of(const std::string& kind) {
    if (kind == "cyclic") return Side::cyclic;
    return kind == "free" ? Side::open : Side::wall;  // grains keep to the inside of an inflow too
}

}  // namespace

CellGrid grid_of(const FluidDomain& domain, double thickness) {
    CellGrid grid;
    grid.dimension = domain.dimension;
    for (int axis = 0; axis < grid.dimension; ++axis) {
        grid.counts[axis] = domain.cells[axis];
        grid.spacing[axis] = domain.size[axis] / domain.cells[axis];
        grid.sides[axis] = {side_of(domain.sides[2 * axis]), side_of(domain.sides[2 * axis + 1])};
    }
    if (stretched(domain)) grid.stretch(1, domain.row_edges);
    if (grid.dimension == 2) grid.spacing[2] = thickness;
    return grid;
}

}  // namespace turbidite
