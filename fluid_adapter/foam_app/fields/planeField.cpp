// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/fields/planeField.hpp"

namespace turbidite {
namespace {

/// Stencils of points in this rank's cells reach two layers beyond them. There is one layer more,
/// so that no rounding of a position makes a stencil leave the halo, which would go unnoticed.
constexpr int halo_layers = 3;

}  // namespace

PlaneField::PlaneField(FluidFields& fields, const FluidDomain& domain)
    : FoamField(fields, domain),
      // A single rank knows every cell without a halo.
      block_(grid(), cell_numbers(), fields.ranks.parallel() ? halo_layers : 0) {
    if (fields.ranks.parallel()) know_halo();
    cells_ = block_.table();
    for (std::vector<double>& halo : halo_velocity_) halo.resize(block_.halo().size());
    copy_velocity();
}

void PlaneField::know_halo() {
    halo_ = std::make_unique<HaloExchange>(fields_.ranks, grid().counts[0] * grid().counts[1],
                                           cell_numbers(), block_.halo());
    // Ordered by owner, as import_halo fills them in
    block_.number_halo(halo_->halo());
    in_a_halo_.assign(owned_cells(), 0);
    shared_cells_ = halo_->shared();
    for (const int cell : shared_cells_) in_a_halo_[cell] = 1;
}

void PlaneField::work_on(FluidStep& step) {
    // The step has no contiguous components: u stays in U and is copied where step 5 needs it.
    if (step.velocity(0) == nullptr) return copy_velocity();
    copies_used_ = false;
    // Not needed any more: their memory is given back.
    for (std::vector<double>& copy : copies_) copy = {};
    for (int axis = 0; axis < 2; ++axis) velocity_[axis] = step.velocity(axis);
}

void PlaneField::copy_velocity() {
    copies_used_ = true;
    for (int axis = 0; axis < 2; ++axis) {
        copies_[axis].resize(owned_cells());
        velocity_[axis] = copies_[axis].data();
    }
}

std::array<const double*, 2> PlaneField::import_halo(const double* x, const double* y) {
    if (halo_) halo_->import({x, y}, {halo_velocity_[0].data(), halo_velocity_[1].data()});
    return {halo_velocity_[0].data(), halo_velocity_[1].data()};
}

void PlaneField::share_sums(double* x, double* y) const {
    if (!halo_) return;
    // Sums to the owners, and from there to all that know the cell: the same bits everywhere
    halo_->export_sums({x, y});
    halo_->import({x, y});
}

Vec3 PlaneField::velocity_of(int cell) const {
    return copies_used_ ? Vec3{fields_.U[cell].x(), fields_.U[cell].y(), 0.0} : constrained(cell);
}

void PlaneField::accelerate(const Vec3& change) {
    if (copies_used_) {
        fields_.U.primitiveFieldRef() += Foam::vector(change[0], change[1], 0.0);
        fields_.U.correctBoundaryConditions();
        return;
    }
    const int owned = owned_cells();
    for (int axis = 0; axis < 2; ++axis)
        for (int cell = 0; cell < owned; ++cell) velocity_[axis][cell] += change[axis];
}

FluidMomentum PlaneField::momentum() const {
    return copies_used_ ? fields_.momentum() : fields_.momentum(velocity_[0], velocity_[1]);
}

void PlaneField::load(const Constraint& constraint) {
    if (!copies_used_) return;
    constraint.for_cells([&](int cell) { load(cell); });
    // Other ranks read these through import_halo, even if no point of this rank uses them.
    for (const int cell : shared_cells_) load(cell);
}

void PlaneField::load(int cell) {
    velocity_[0][cell] = fields_.U[cell].x();
    velocity_[1][cell] = fields_.U[cell].y();
}

void PlaneField::store(const Constraint& constraint) {
    if (!copies_used_) return;
    constraint.for_cells([&](int cell) {
        fields_.U[cell] = Foam::vector(velocity_[0][cell], velocity_[1][cell], 0.0);
    });
    fields_.U.correctBoundaryConditions();
}

}  // namespace turbidite
