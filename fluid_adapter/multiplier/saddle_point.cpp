// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/saddle_point.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <string>

#include "fluid_adapter/multiplier/memory_prefetch.hpp"

namespace turbidite {
namespace {

/// Throws unless a grain has a positive inertia together with all the fluid that its multipliers
/// tie to it: it is lighter than the fluid and ties too little of it. The fluid in its interior
/// cells alone need not suffice: S is then indefinite, and so is its preconditioner, whose quotient
/// stays positive.
void demand_positive(const Eigen::Matrix3d& effective, GrainId id) {
    if (effective.llt().info() == Eigen::Success) return;
    std::ostringstream text;
    text << "grain " << id << " and the fluid tied to it have mass " << effective(0, 0)
         << " kg/m and moment of inertia " << effective(2, 2)
         << " kg m, which is not positive definite: use a larger grains.density_ratio, more "
            "fluid.cells_per_diameter, or check why the grain ties no fluid";
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
    find_border();
    multipliers_.assign_zero(rows(), grains.size());
    slip_.resize(rows());
    sum_interiors();
    factorise();
    move_grains();
    import_velocity();
    BoundaryOperator(points).apply(cells_.data(), motions_.data(), slip_.data());
}

void SaddlePoint::find_border() {
    border_.clear();
    if (!field_->has_halo()) return;
    for (int slot = 0; slot < points_->slots(); ++slot)
        if (const int cell = points_->stencilled[slot].cell; field_->shares(cell))
            border_.push_back({slot, cell});
}

/// cells = u, the velocities at the slots.
void SaddlePoint::import_velocity() {
    const double* ux = field_->velocity(0);
    const double* uy = field_->velocity(1);
    const auto [halo_x, halo_y] = field_->import_halo();
    const int owned = field_->owned_cells();
    cells_.resize(points_->slots());
    for (int slot = 0; slot < points_->slots(); ++slot) {
        expect_velocity(slot, ux, uy);
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
    coupling_.begin(*field_, *points_);
    blocks_.factorise(*field_, *grains_, *points_, coupling_);
    tied_ = blocks_.tied_inertia();
    sum_over_holders(tied_);
    effective_.resize(grains_->size());
    inverse_.resize(grains_->size());
    inverse_effective_.resize(grains_->size());
    momentum_.resize(grains_->size());
    for (std::size_t g = 0; g < grains_->size(); ++g) {
        const Eigen::Matrix3d body =
            body_inertia((*grains_)[g], sums_[g], field_->reference_mass());
        inverse_[g] = body.inverse();
        effective_[g] = body + tied_[g];
        demand_positive(effective_[g], ids_[g]);
        inverse_effective_[g] = effective_[g].inverse();
        momentum_[g] = body_momentum((*grains_)[g], sums_[g], field_->reference_mass());
    }
}

/// U = A^-1 (P + J + T^T L).
void SaddlePoint::move_grains() {
    motions_.resize(grains_->size());
    for (std::size_t g = 0; g < motions_.size(); ++g)
        motions_[g] = inverse_[g] * (momentum_[g] + multipliers_.on_grains[g]);
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

/// S w = G w + T A^-1 T^T w.
void SaddlePoint::apply(const Multipliers& w, double* y) {
    coupling_.apply(*field_, w.values.data(), y);
    by_grain_.resize(grains_->size());
    for (std::size_t g = 0; g < by_grain_.size(); ++g)
        by_grain_[g] = -(inverse_[g] * w.on_grains[g]);
    BoundaryOperator(*points_).subtract_motion(by_grain_.data(), y);
}

/// G^-1 by blocks, with T A^-1 T^T added by the formula of Woodbury: with s = T^T G^-1 r and
/// q = (A + T^T G^-1 T)^-1 s
///
///     z = G^-1 (r - T q),    T^T z = s - T^T G^-1 T q
void SaddlePoint::precondition(const double* r, Multipliers& z) {
    blocks_.solve(r, z.values.data());
    BoundaryOperator(*points_).sum_by_grain(z.values.data(), z.on_grains.data());
    sum_over_holders(z.on_grains);
    by_grain_.resize(grains_->size());
    for (std::size_t g = 0; g < by_grain_.size(); ++g) {
        by_grain_[g] = inverse_effective_[g] * z.on_grains[g];
        z.on_grains[g] -= tied_[g] * by_grain_[g];
    }
    blocks_.subtract_images(by_grain_.data(), z.values.data());
}

void SaddlePoint::add(const Multipliers& w) {
    for (std::size_t i = 0; i < w.values.size(); ++i) multipliers_.values[i] += w.values[i];
    for (std::size_t g = 0; g < w.on_grains.size(); ++g)
        multipliers_.on_grains[g] += w.on_grains[g];
    move_grains();
}

void SaddlePoint::impose() {
    spread_multipliers();
    impulses_.resize(grains_->size());
    BoundaryOperator(*points_).sum_by_grain(multipliers_.values.data(), impulses_.data());
    for (std::size_t g = 0; g < grains_->size(); ++g)
        impulses_[g] += carry_cells(*points_, *field_, static_cast<int>(g), motions_[g]);
    sum_over_holders(impulses_);
    double* ux = field_->velocity(0);
    double* uy = field_->velocity(1);
    const double per_mass = 1.0 / field_->reference_mass();
    for (int slot = 0; slot < points_->slots(); ++slot) {
        expect_velocity(slot, ux, uy);
        const StencilCell& at = points_->stencilled[slot];
        if (!field_->owns(at.cell)) continue;
        ux[at.cell] -= per_mass / at.volume * cells_[slot].x;
        uy[at.cell] -= per_mass / at.volume * cells_[slot].y;
    }
}

/// Asks for the velocity of a later slot's cell.
void SaddlePoint::expect_velocity(int slot, const double* ux, const double* uy) const {
    constexpr int ahead = 24;
    if (slot + ahead >= points_->slots()) return;
    const int cell = points_->stencilled[slot + ahead].cell;
    if (!field_->owns(cell)) return;
    ask_for(&ux[cell]);
    ask_for(&uy[cell]);
}

/// cells = B^T L, of the points of all ranks.
void SaddlePoint::spread_multipliers() {
    std::fill(cells_.begin(), cells_.end(), PlaneVector{});
    BoundaryOperator(*points_).spread(multipliers_.values.data(), cells_.data());
    border_sums_.sum(*field_, border_, cells_.data());
}

double SaddlePoint::dot(const double* a, const double* b) const {
    using Vector = Eigen::Map<const Eigen::VectorXd>;
    double sum = Vector(a, rows()).dot(Vector(b, rows()));
    field_->sum_over_ranks(&sum, 1);
    return sum;
}

double SaddlePoint::points_everywhere() const {
    double count = points_->boundary_points();
    field_->sum_over_ranks(&count, 1);
    return count;
}

}  // namespace turbidite
