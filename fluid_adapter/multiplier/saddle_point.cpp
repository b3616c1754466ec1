// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/saddle_point.hpp"

#include <Eigen/LU>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <string>

namespace turbidite {
namespace {

/// Throws when a grain and the fluid it covers have no positive inertia: it is lighter than the
/// fluid and covers too little.
void demand_positive(const Eigen::Matrix3d& inertia, GrainId id) {
    if (inertia(0, 0) > 0.0 && inertia.determinant() > 0.0) return;
    std::ostringstream text;
    text << "grain " << id << " and the fluid it covers have mass " << inertia(0, 0)
         << " kg/m and determinant " << inertia.determinant()
         << " of their inertia; both must be positive: use a larger grains.density_ratio, or see "
            "why the grain covers no fluid";
    throw std::runtime_error(text.str());
}

}  // namespace

void SaddlePoint::assemble(FluidField& field, const std::vector<ImmersedGrain>& grains,
                           const CollocationPoints& points) {
    field_ = &field;
    grains_ = &grains;
    points_ = &points;
    ids_.clear();
    for (const ImmersedGrain& grain : grains) ids_.push_back(grain.id);
    field.hold_grains(ids_.data(), static_cast<int>(ids_.size()));
    cells_x_.resize(field.local_cells(), 0.0);
    cells_y_.resize(field.local_cells(), 0.0);
    multipliers_.assign(rows(), 0.0);
    slip_.resize(rows());
    sum_interiors();
    factorise();
    move_grains();
    field.import_halo(field.velocity(0), field.velocity(1));
    BoundaryOperator(points).apply(field.velocity(0), field.velocity(1), motions_.data(),
                                   slip_.data());
}

void SaddlePoint::sum_interiors() {
    sums_.resize(grains_->size());
    for (std::size_t g = 0; g < grains_->size(); ++g)
        sums_[g] = sum_cells(*points_, *field_, static_cast<int>(g));
    sum_over_holders(sums_);
}

void SaddlePoint::factorise() {
    blocks_.factorise(*field_, *grains_, *points_);
    effective_ = blocks_.tied_inertia();
    sum_over_holders(effective_);
    inverse_.resize(grains_->size());
    inverse_effective_.resize(grains_->size());
    momentum_.resize(grains_->size());
    for (std::size_t g = 0; g < grains_->size(); ++g) {
        const Eigen::Matrix3d body = body_inertia((*grains_)[g], sums_[g], field_->cell_mass());
        demand_positive(body, ids_[g]);
        inverse_[g] = body.inverse();
        effective_[g] += body;
        inverse_effective_[g] = effective_[g].inverse();
        momentum_[g] = body_momentum((*grains_)[g], sums_[g], field_->cell_mass());
    }
}

/// U = A^-1 (P + J + T^T L).
void SaddlePoint::move_grains() {
    motions_.resize(grains_->size());
    BoundaryOperator(*points_).sum_by_grain(multipliers_.data(), motions_.data());
    sum_over_holders(motions_);
    for (std::size_t g = 0; g < motions_.size(); ++g)
        motions_[g] = inverse_[g] * (momentum_[g] + motions_[g]);
}

void SaddlePoint::push(const std::vector<Planar>& impulses) {
    rows_.resize(grains_->size());
    for (std::size_t g = 0; g < rows_.size(); ++g) {
        momentum_[g] += impulses[g];
        rows_[g] = inverse_[g] * impulses[g];
        motions_[g] += rows_[g];
    }
    BoundaryOperator(*points_).subtract_motion(rows_.data(), slip_.data());
}

void SaddlePoint::apply(const double* w, double* y) {
    const BoundaryOperator boundary(*points_);
    spread(w);
    field_->import_halo(cells_x_.data(), cells_y_.data());
    rows_.resize(grains_->size());
    boundary.sum_by_grain(w, rows_.data());
    sum_over_holders(rows_);
    for (std::size_t g = 0; g < rows_.size(); ++g) rows_[g] = -(inverse_[g] * rows_[g]);
    boundary.apply(cells_x_.data(), cells_y_.data(), rows_.data(), y);
}

/// (B B^T/m)^-1 by blocks, with T A^-1 T^T added by the formula of Woodbury.
void SaddlePoint::precondition(const double* r, double* z) {
    const BoundaryOperator boundary(*points_);
    blocks_.solve(r, z);
    rows_.resize(grains_->size());
    boundary.sum_by_grain(z, rows_.data());
    sum_over_holders(rows_);
    for (std::size_t g = 0; g < rows_.size(); ++g) rows_[g] = inverse_effective_[g] * rows_[g];
    blocks_.subtract_images(rows_.data(), z);
}

void SaddlePoint::add(const std::vector<double>& w) {
    for (std::size_t i = 0; i < w.size(); ++i) multipliers_[i] += w[i];
    move_grains();
}

void SaddlePoint::impose() {
    spread(multipliers_.data());
    impulses_.resize(grains_->size());
    BoundaryOperator(*points_).sum_by_grain(multipliers_.data(), impulses_.data());
    for (std::size_t g = 0; g < grains_->size(); ++g)
        impulses_[g] += carry_cells(*points_, *field_, static_cast<int>(g), motions_[g]);
    sum_over_holders(impulses_);
    for (const int cell : points_->stencilled) {
        if (field_->owns(cell)) {
            field_->velocity(0)[cell] -= cells_x_[cell];
            field_->velocity(1)[cell] -= cells_y_[cell];
        }
        cells_x_[cell] = cells_y_[cell] = 0.0;  // halos export all they have, next window too
    }
}

/// cells = B^T values / m on owned cells, halos summed into them.
void SaddlePoint::spread(const double* values) {
    for (const int cell : points_->stencilled) cells_x_[cell] = cells_y_[cell] = 0.0;
    BoundaryOperator(*points_).spread(values, cells_x_.data(), cells_y_.data());
    field_->export_halo(cells_x_.data(), cells_y_.data());
    const double per_mass = 1.0 / field_->cell_mass();
    for (const int cell : points_->stencilled) {
        cells_x_[cell] *= per_mass;
        cells_y_[cell] *= per_mass;
    }
}

double SaddlePoint::dot(const double* a, const double* b) const {
    double sum = std::inner_product(a, a + rows(), b, 0.0);
    field_->sum_over_ranks(&sum, 1);
    return sum;
}

double SaddlePoint::points_everywhere() const {
    double count = points_->boundary_points();
    field_->sum_over_ranks(&count, 1);
    return count;
}

}  // namespace turbidite
