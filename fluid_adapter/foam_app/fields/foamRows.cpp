// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/fields/foamRows.hpp"

#include "fluid_adapter/foam_app/fields/sideVelocity.hpp"

namespace turbidite {

int FoamRows::first_row() const {
    return rows_.rows_of_rank()[fields_.ranks.rank()].first;
}

void FoamRows::read_velocity(const VelocityPointers& u) {
    const Foam::vectorField& U = fields_.U.primitiveField();
    for (int axis = 0; axis < u.size(); ++axis)
        rows_.gather([&](int c) { return U[c][axis]; }, u[axis]);
}

void FoamRows::write_velocity(const VelocityPointers& u) {
    Foam::vectorField& U = fields_.U.primitiveFieldRef();
    for (int axis = 0; axis < u.size(); ++axis)
        rows_.scatter(u[axis], [&](int c, double value) { U[c][axis] = value; });
    fields_.U.correctBoundaryConditions();
}

void FoamRows::read_pressure(double* rows) {
    const Foam::scalarField& p = fields_.p.primitiveField();
    rows_.gather([&](int c) { return p[c]; }, rows);
}

void FoamRows::write_pressure(const double* rows, bool floating) {
    Foam::scalarField& p = fields_.p.primitiveFieldRef();
    // Where no side fixes p, it is zero in cell (0, 0) of the box.
    const double level = floating ? rows_.first(rows) : 0.0;
    rows_.scatter(rows, [&](int c, double value) { p[c] = value - level; });
    fields_.p.correctBoundaryConditions();
}

PlaneRows::PlaneRows(FluidFields& fields, const BoxCells& box)
    : FoamRows(fields, CellRows(fields.ranks, box.cells[0], box.cells[1], box.place)), box_(box) {}

VelocityOnSides PlaneRows::side_velocity() const {
    return held_on_sides(fields_, box_);
}

SpaceRows::SpaceRows(FluidFields& fields, const CellGrid& grid, const std::vector<int>& cells)
    : FoamRows(fields,
               CellRows(fields.ranks, grid.counts[0] * grid.counts[2], grid.counts[1], cells)),
      grid_(grid) {}

VelocityOnSides SpaceRows::side_velocity() const {
    return held_on_sides(fields_, grid_);
}

}  // namespace turbidite
