// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/saddle_point.hpp"

#include <numeric>

namespace turbidite {

void SaddlePoint::assemble(FluidField& field, const std::vector<ImmersedGrain>& grains,
                           const CollocationPoints& points) {
    field_ = &field;
    grains_ = &grains;
    points_ = &points;
    cells_x_.resize(field.local_cells());
    cells_y_.resize(field.local_cells());
    motions_.resize(grains.size());
    sums_.resize(grains.size());
    ids_.clear();
    for (const ImmersedGrain& grain : grains) ids_.push_back(grain.id);
}

void SaddlePoint::initial_slip(double* slip) {
    for (std::size_t g = 0; g < grains_->size(); ++g) motions_[g] = (*grains_)[g].free_motion();
    field_->import_halo(field_->velocity(0));
    field_->import_halo(field_->velocity(1));
    ConstraintOperator(*points_).apply(field_->velocity(0), field_->velocity(1), motions_.data(),
                                       slip);
}

void SaddlePoint::apply(const double* w, double* y) {
    const ConstraintOperator constraint(*points_);
    clear_touched();
    constraint.spread(w, cells_x_.data(), cells_y_.data());
    share(cells_x_.data());
    share(cells_y_.data());
    const double per_mass = 1.0 / field_->cell_mass();
    for (int cell : points_->touched) {
        cells_x_[cell] *= per_mass;
        cells_y_[cell] *= per_mass;
    }
    constraint.sum_by_grain(w, motions_.data());
    sum_over_holders(motions_);
    for (std::size_t g = 0; g < grains_->size(); ++g) {
        const ImmersedGrain& grain = (*grains_)[g];
        motions_[g].head<2>() /= -grain.effective_mass;
        motions_[g].z() /= -grain.effective_inertia;
    }
    constraint.apply(cells_x_.data(), cells_y_.data(), motions_.data(), y);
}

void SaddlePoint::impose(const double* impulses) {
    const ConstraintOperator constraint(*points_);
    clear_touched();
    constraint.spread(impulses, cells_x_.data(), cells_y_.data());
    share(cells_x_.data());
    share(cells_y_.data());
    const double per_mass = 1.0 / field_->cell_mass();
    for (int cell : points_->touched) {
        field_->velocity(0)[cell] -= per_mass * cells_x_[cell];
        field_->velocity(1)[cell] -= per_mass * cells_y_[cell];
    }
    constraint.sum_by_grain(impulses, sums_.data());
    sum_over_holders(sums_);
    for (std::size_t g = 0; g < grains_->size(); ++g) {
        const ImmersedGrain& grain = (*grains_)[g];
        motions_[g] = grain.free_motion() + Planar(sums_[g].x() / grain.effective_mass,
                                                   sums_[g].y() / grain.effective_mass,
                                                   sums_[g].z() / grain.effective_inertia);
    }
}

double SaddlePoint::dot(const double* a, const double* b) const {
    double sum = std::inner_product(a, a + rows(), b, 0.0);
    field_->sum_over_ranks(&sum, 1);
    return sum;
}

double SaddlePoint::points_everywhere() const {
    double count = points_->size();
    field_->sum_over_ranks(&count, 1);
    return count;
}

void SaddlePoint::clear_touched() {
    for (int cell : points_->touched) cells_x_[cell] = cells_y_[cell] = 0.0;
}

void SaddlePoint::share(double* cells) const {
    field_->export_halo(cells);
    field_->import_halo(cells);
}

}  // namespace turbidite
