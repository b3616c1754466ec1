// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/box_app/box_field.hpp"

#include "fluid_adapter/fluid_window/layer_momentum.hpp"

namespace turbidite {

BoxField::BoxField(const CellGrid& grid, double density, const RankGroup& ranks, const Span& layers)
    : grid_(grid),
      ranks_(ranks),
      layers_(layers),
      mass_(density * grid.spacing[0] * grid.spacing[1] * grid.spacing[2]),
      p_(owned_cells()) {
    // A single rank holds every grain alone: nothing is summed.
    if (ranks.parallel()) shared_ = std::make_unique<SharedGrains>(ranks);
}

void BoxField::work_on(FluidStep& step) {
    for (int axis = 0; axis < 3; ++axis) velocity_[axis] = step.velocity(axis);
    rows_ = step.rows();
}

void BoxField::set_pressure(const double* p, double level) {
    p_.assign(p, p + owned_cells());
    level_ = level;
}

void BoxField::hold_grains(const GrainId* ids, int count) const {
    if (shared_) shared_->hold(ids, count);
}

void BoxField::sum_over_holders(double* rows, int per_grain) const {
    if (shared_) shared_->sum(rows, per_grain);
}

void BoxField::import_layers(const VelocityPointers& u, LayersBeside& beside) const {
    if (ranks_.parallel()) import_layers_of(*rows_, u, layers(), beside);
}

void BoxField::accelerate(const Vec3& change) {
    const int cells = owned_cells();
    for (int axis = 0; axis < 3; ++axis)
        for (int cell = 0; cell < cells; ++cell) velocity_[axis][cell] += change[axis];
}

FluidMomentum BoxField::momentum() const {
    return momentum_of_layers(*this, velocity_, ranks_);
}

Vec3 BoxField::shown_velocity(int cell) const {
    return {velocity_[0][cell], velocity_[1][cell], velocity_[2][cell]};
}

}  // namespace turbidite
