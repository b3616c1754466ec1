// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/saddle_point.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <string>

namespace turbidite {
namespace {

/// Throws if the inertia of a grain with its covered fluid is not positive: the grain is lighter
/// than the fluid and covers too little of it.
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
    number_cells();
    multipliers_.assign(rows(), 0.0);
    slip_.resize(rows());
    sum_interiors();
    factorise();
    move_grains();
    import_velocity();
    BoundaryOperator(points).apply(cells_.data(), motions_.data(), slip_.data());
}

/// Masses of the cells used for interpolation, and which of these cells other ranks know too.
void SaddlePoint::number_cells() {
    cells_.resize(points_->slots());
    per_mass_.clear();
    border_.clear();
    const double per_mass = 1.0 / field_->reference_mass();
    for (const StencilCell& at : points_->stencilled) {
        if (field_->shares(at.cell)) border_.push_back(static_cast<int>(per_mass_.size()));
        per_mass_.push_back(per_mass / at.volume);
    }
    share_x_.resize(field_->local_cells(), 0.0);
    share_y_.resize(field_->local_cells(), 0.0);
}

/// cells = u, the velocities at the slots.
void SaddlePoint::import_velocity() {
    const double* ux = field_->velocity(0);
    const double* uy = field_->velocity(1);
    const auto [halo_x, halo_y] = field_->import_halo();
    const int owned = field_->owned_cells();
    for (int slot = 0; slot < points_->slots(); ++slot) {
        const int cell = points_->stencilled[slot].cell;
        cells_[slot] = cell < owned ? PlaneVector{ux[cell], uy[cell]}
                                    : PlaneVector{halo_x[cell - owned], halo_y[cell - owned]};
    }
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
        const Eigen::Matrix3d body =
            body_inertia((*grains_)[g], sums_[g], field_->reference_mass());
        demand_positive(body, ids_[g]);
        inverse_[g] = body.inverse();
        effective_[g] += body;
        inverse_effective_[g] = effective_[g].inverse();
        momentum_[g] = body_momentum((*grains_)[g], sums_[g], field_->reference_mass());
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
    by_grain_.resize(grains_->size());
    for (std::size_t g = 0; g < by_grain_.size(); ++g) {
        momentum_[g] += impulses[g];
        by_grain_[g] = inverse_[g] * impulses[g];
        motions_[g] += by_grain_[g];
    }
    BoundaryOperator(*points_).subtract_motion(by_grain_.data(), slip_.data());
}

/// y = S w = B m^-1 B^T w + T A^-1 T^T w.
void SaddlePoint::apply(const double* w, double* y) {
    const BoundaryOperator boundary(*points_);
    spread(w);
    by_grain_.resize(grains_->size());
    boundary.sum_by_grain(w, by_grain_.data());
    sum_over_holders(by_grain_);
    for (std::size_t g = 0; g < by_grain_.size(); ++g) by_grain_[g] = -(inverse_[g] * by_grain_[g]);
    boundary.apply(cells_.data(), by_grain_.data(), y);
}

/// z = C^-1 r, with C = G + T A^-1 T^T block by block and its inverse by the Woodbury formula:
/// C^-1 = G^-1 - G^-1 T (A + T^T G^-1 T)^-1 T^T G^-1.
void SaddlePoint::precondition(const double* r, double* z) {
    const BoundaryOperator boundary(*points_);
    blocks_.solve(r, z);
    by_grain_.resize(grains_->size());
    boundary.sum_by_grain(z, by_grain_.data());
    sum_over_holders(by_grain_);
    for (std::size_t g = 0; g < by_grain_.size(); ++g)
        by_grain_[g] = inverse_effective_[g] * by_grain_[g];
    blocks_.subtract_images(by_grain_.data(), z);
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
    double* ux = field_->velocity(0);
    double* uy = field_->velocity(1);
    for (int slot = 0; slot < points_->slots(); ++slot) {
        const int cell = points_->stencilled[slot].cell;
        if (!field_->owns(cell)) continue;
        ux[cell] -= cells_[slot].x;
        uy[cell] -= cells_[slot].y;
    }
}

/// cells = m^-1 B^T values, from the points of all ranks.
void SaddlePoint::spread(const double* values) {
    std::fill(cells_.begin(), cells_.end(), PlaneVector{});
    BoundaryOperator(*points_).spread(values, cells_.data());
    share_sums();
    for (int slot = 0; slot < points_->slots(); ++slot) {
        cells_[slot].x *= per_mass_[slot];
        cells_[slot].y *= per_mass_[slot];
    }
}

/// Values that several ranks have spread into the same cell are summed on its owner, and the sums
/// are returned.
void SaddlePoint::share_sums() {
    for (const int slot : border_) {
        const int cell = points_->stencilled[slot].cell;
        share_x_[cell] = cells_[slot].x;
        share_y_[cell] = cells_[slot].y;
    }
    field_->share_sums(share_x_.data(), share_y_.data());
    for (const int slot : border_) {
        const int cell = points_->stencilled[slot].cell;
        cells_[slot] = {share_x_[cell], share_y_[cell]};
        share_x_[cell] = share_y_[cell] = 0.0;  // for the next call
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
