// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/foamFluidField.hpp"

#include <cmath>

#include "coupler/protocol/failure.hpp"

namespace turbidite {
namespace {

/// Cell centres may be off by this share of a cell: blockMesh's points are written as text.
constexpr double placement_tolerance = 1e-4;

Side side_of(const std::string& kind) {
    return kind == "wall" ? Side::wall : kind == "cyclic" ? Side::cyclic : Side::open;
}

CellGrid grid_of(const FluidDomain& domain, double thickness) {
    CellGrid grid;
    for (int axis = 0; axis < 2; ++axis) {
        grid.counts[axis] = domain.cells[axis];
        grid.spacing[axis] = domain.size[axis] / domain.cells[axis];
        grid.sides[axis] = {side_of(domain.sides[2 * axis]), side_of(domain.sides[2 * axis + 1])};
    }
    grid.spacing[2] = thickness;
    return grid;
}

}  // namespace

FoamFluidField::FoamFluidField(FluidFields& fields, const FluidDomain& domain)
    : fields_(fields), grid_(grid_of(domain, fields.thickness)) {
    if (Foam::Pstream::parRun())
        throw Failure(ExitCode::bad_input,
                      "fluid.ranks: the multiplier step runs on one rank so far; set it to 1");
    owned_ = fields.mesh.nCells();
    x_.resize(owned_);
    y_.resize(owned_);
    cell_mass_ = fields.rho * grid_.spacing[0] * grid_.spacing[1];
    map_cells();
}

void FoamFluidField::map_cells() {
    local_.assign(static_cast<std::size_t>(grid_.counts[0]) * grid_.counts[1], -1);
    bool uniform = true;
    forAll(fields_.mesh.C(), c) {
        const Foam::point& centre = fields_.mesh.C()[c];
        int index[2];
        for (int axis = 0; axis < 2; ++axis) {
            index[axis] = grid_.wrapped(axis, grid_.layer(axis, centre[axis]));
            const double off = centre[axis] - grid_.centre(axis, std::max(index[axis], 0));
            uniform &=
                index[axis] >= 0 && std::abs(off) < placement_tolerance * grid_.spacing[axis];
        }
        if (!uniform) break;
        local_[index[0] + static_cast<std::size_t>(grid_.counts[0]) * index[1]] = c;
    }
    for (int cell : local_) uniform &= cell >= 0;
    if (!uniform)
        throw Failure(ExitCode::bad_input,
                      "the fluid mesh is not the uniform grid of " +
                          std::to_string(grid_.counts[0]) + " x " +
                          std::to_string(grid_.counts[1]) +
                          " cells that the case asks for: run blockMesh on the fluid case again");
}

int FoamFluidField::cell(int i, int j, int k) const {
    if (i < 0 || j < 0 || k != 0 || i >= grid_.counts[0] || j >= grid_.counts[1]) return -1;
    return local_[i + static_cast<std::size_t>(grid_.counts[0]) * j];
}

void FoamFluidField::load() {
    forAll(fields_.U, c) {
        x_[c] = fields_.U[c].x();
        y_[c] = fields_.U[c].y();
    }
}

void FoamFluidField::store(const CollocationPoints& points, bool force_density) {
    if (force_density) fields_.lambda.primitiveFieldRef() = Foam::Zero;
    for (const InteriorCell& point : points.interior) store(point.cell, force_density);
    for (const int cell : points.stencilled)
        if (owns(cell)) store(cell, force_density);
    fields_.U.correctBoundaryConditions();
}

void FoamFluidField::store(int cell, bool force_density) {
    const Foam::vector corrected(x_[cell], y_[cell], 0.0);
    if (force_density)
        fields_.lambda[cell] =
            fields_.rho / fields_.time.deltaTValue() * (fields_.U[cell] - corrected);
    fields_.U[cell] = corrected;
}

}  // namespace turbidite
