// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/box_app/array_store.hpp"

#include <cmath>
#include <numeric>
#include <utility>

#include "fluid_adapter/fluid_window/box_of_grid.hpp"

namespace turbidite {
namespace {

BoxFluid fluid_of(const ArrayBox& box) {
    BoxFluid fluid = box_of(box.grid);
    fluid.viscosity = box.viscosity;
    fluid.central = box.central;
    fluid.second_order = box.second_order;
    return fluid;
}

}  // namespace

CellGrid grid_of_cubes(const std::array<int, 3>& cells, double edge,
                       const std::array<Side, 3>& sides) {
    CellGrid grid;
    grid.dimension = cells[2] > 1 ? 3 : 2;
    grid.counts = cells;
    grid.spacing = {edge, edge, grid.dimension == 3 ? edge : 1.0};
    for (int axis = 0; axis < grid.dimension; ++axis) grid.sides[axis].fill(sides[axis]);
    return grid;
}

ArrayRows::ArrayRows(const CellGrid& grid) : sides_(sides_at_rest(grid)) {}

ArrayField::ArrayField(const ArrayBox& box)
    : grid_(box.grid),
      cells_(grid_.counts[0] * grid_.counts[1] * grid_.counts[2]),
      mass_(box.density * grid_.spacing[0] * grid_.spacing[1] * grid_.spacing[2]) {
    if (grid_.dimension == 3) return;
    index_.resize(cells_);
    std::iota(index_.begin(), index_.end(), 0);
    // The block is the whole grid, so nothing is beyond it even where a side is cyclic.
    table_ = {index_.data(), {0, 0}, {grid_.counts[0], grid_.counts[1]}, {0, 0}};
}

void ArrayField::work_on(FluidStep& step) {
    for (int axis = 0; axis < grid_.dimension; ++axis) velocity_[axis] = step.velocity(axis);
}

void ArrayField::accelerate(const Vec3& change) {
    for (int axis = 0; axis < grid_.dimension; ++axis)
        for (int c = 0; c < cells_; ++c) velocity_[axis][c] += change[axis];
}

FluidMomentum ArrayField::momentum() const {
    FluidMomentum of;
    for (int axis = 0; axis < grid_.dimension; ++axis)
        for (int c = 0; c < cells_; ++c) {
            of.sum[axis] += mass_ * velocity_[axis][c];
            of.magnitudes += mass_ * std::abs(velocity_[axis][c]);
        }
    return of;
}

Vec3 ArrayField::shown_velocity(int cell) const {
    Vec3 u{};
    for (int axis = 0; axis < grid_.dimension; ++axis) u[axis] = velocity_[axis][cell];
    return u;
}

ArrayStore::ArrayStore(const ArrayBox& box)
    : ArrayStore(box, std::make_unique<ArrayRows>(box.grid)) {}

ArrayStore::ArrayStore(const ArrayBox& box, std::unique_ptr<RowFields> rows)
    : density_(box.density), field_(box) {
    const BoxFluid fluid = fluid_of(box);
    step_ = std::make_unique<BoxFluidStep>(fluid, std::make_unique<AllRows>(fluid.pressure),
                                           std::move(rows), ranks_, box.rigid_grains);
    field_.work_on(*step_);
}

}  // namespace turbidite
