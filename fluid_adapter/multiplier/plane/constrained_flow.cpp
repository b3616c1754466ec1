// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/plane/constrained_flow.hpp"

#include <algorithm>

#include "fluid_adapter/multiplier/memory_prefetch.hpp"

namespace turbidite {

void ConstrainedFlow::begin(SaddleOperator& system, const VelocityPointers& velocity,
                            const std::vector<Planar>& momenta,
                            const std::vector<Planar>& prescribed) {
    system_ = &system;
    velocity_ = velocity;
    momentum_ = momenta;
    prescribed_ = prescribed;
    find_border();
    multipliers_.assign_zero(system.rows(), system.grains());
    impulses_.assign(system.grains(), Planar::Zero());
    slip_.resize(system.rows());
    // At L = 0: U = A^-1 P and the slip s = B u3 - T U.
    sum_momenta();
    move_grains();
    import_velocity();
    BoundaryOperator(points()).apply(cells_.data(), motions_.data(), slip_.data());
}

void ConstrainedFlow::begin(SaddleOperator& system, const VelocityPointers& change) {
    const std::vector<Planar> none(system.grains(), Planar::Zero());
    begin(system, change, none, none);
}

void ConstrainedFlow::find_border() {
    border_.clear();
    // On one rank no cell is known to others.
    if (!field().has_halo()) return;
    for (int slot = 0; slot < points().slots(); ++slot)
        if (const int cell = points().stencilled[slot].cell; field().shares(cell))
            border_.push_back({slot, cell});
}

/// P gains the momentum of the covered fluid.
void ConstrainedFlow::sum_momenta() {
    const double m = field().reference_mass();
    by_grain_.resize(system_->grains());
    for (std::size_t g = 0; g < by_grain_.size(); ++g)
        by_grain_[g] = sum_velocity(points(), velocity_, static_cast<int>(g));
    // Each rank has the sum over the cells it owns.
    system_->sum_over_holders(by_grain_);
    // P = P of the grain + sum m (u_x, u_y, r x u), as in covered_fluid.hpp
    for (std::size_t g = 0; g < by_grain_.size(); ++g) momentum_[g] += m * by_grain_[g];
}

/// cells = u, the velocities at the slots.
void ConstrainedFlow::import_velocity() {
    const auto [halo_x, halo_y] = field().import_halo(velocity_[0], velocity_[1]);
    const int owned = field().owned_cells();
    cells_.resize(points().slots());
    for (int slot = 0; slot < points().slots(); ++slot) {
        expect_velocity(slot);
        const int cell = points().stencilled[slot].cell;
        cells_[slot] = cell < owned ? PlaneVector{velocity_[0][cell], velocity_[1][cell]}
                                    : PlaneVector{halo_x[cell - owned], halo_y[cell - owned]};
    }
}

/// U = A^-1 (P + J + T^T L), or as prescribed, where A^-1 = 0.
void ConstrainedFlow::move_grains() {
    motions_.resize(system_->grains());
    for (std::size_t g = 0; g < motions_.size(); ++g)
        motions_[g] = prescribed_[g] +
                      system_->inverse_inertia()[g] * (momentum_[g] + multipliers_.on_grains[g]);
}

void ConstrainedFlow::push(const std::vector<Planar>& impulses) {
    by_grain_.resize(system_->grains());
    for (std::size_t g = 0; g < by_grain_.size(); ++g) {
        // P += J, U += A^-1 J, and the slip loses T A^-1 J. The next solve goes on from L.
        momentum_[g] += impulses[g];
        by_grain_[g] = system_->inverse_inertia()[g] * impulses[g];
        motions_[g] += by_grain_[g];
    }
    BoundaryOperator(points()).subtract_motion(by_grain_.data(), slip_.data());
}

void ConstrainedFlow::add(const Multipliers& w) {
    // The slip is not recomputed: uzawa_cg has updated it along with w.
    for (std::size_t i = 0; i < w.values.size(); ++i) multipliers_.values[i] += w.values[i];
    for (std::size_t g = 0; g < w.on_grains.size(); ++g)
        multipliers_.on_grains[g] += w.on_grains[g];
    move_grains();
}

void ConstrainedFlow::impose() {
    // What a grain gains is what the fluid loses: T^T L at the points, and
    // sum m (u - U - omega x r) in the cells it covers. So momentum is kept to rounding,
    // whatever slip is left.
    spread_multipliers();
    by_grain_.resize(system_->grains());
    BoundaryOperator(points()).sum_by_grain(multipliers_.values.data(), by_grain_.data());
    for (std::size_t g = 0; g < by_grain_.size(); ++g)
        by_grain_[g] += carry_cells(points(), velocity_, static_cast<int>(g), motions_[g],
                                    field().reference_mass());
    system_->sum_over_holders(by_grain_);
    // u -= m^-1 B^T L. By rule 6 of collocation_points.hpp none of these cells is covered.
    const double per_mass = 1.0 / field().reference_mass();
    for (int slot = 0; slot < points().slots(); ++slot) {
        expect_velocity(slot);
        const StencilCell& at = points().stencilled[slot];
        // cells_ has the sums over all ranks, and only the owner applies them.
        if (!field().owns(at.cell)) continue;
        velocity_[0][at.cell] -= per_mass / at.volume * cells_[slot].x;
        velocity_[1][at.cell] -= per_mass / at.volume * cells_[slot].y;
    }
    for (std::size_t g = 0; g < by_grain_.size(); ++g) {
        impulses_[g] += by_grain_[g];
        // With T^T L in P, L = 0 stands for the same motions: the next solve begins there.
        momentum_[g] += multipliers_.on_grains[g];
    }
    multipliers_.assign_zero(system_->rows(), system_->grains());
}

void ConstrainedFlow::copy_to(GrainChange& change) const {
    change.clear();
    // All of them are linear in the change. The order is that of `add`.
    for (const std::vector<Planar>* list : {&momentum_, &prescribed_, &motions_, &impulses_})
        for (const Planar& of : *list) change.insert(change.end(), of.begin(), of.end());
    change.insert(change.end(), slip_.begin(), slip_.end());
}

void ConstrainedFlow::add(const GrainChange& change, double share) {
    const double* value = change.data();
    for (std::vector<Planar>* list : {&momentum_, &prescribed_, &motions_, &impulses_})
        for (Planar& of : *list)
            for (double& component : of) component += share * *value++;
    for (double& slip : slip_) slip += share * *value++;
}

/// Asks for the velocity of a later slot's cell.
void ConstrainedFlow::expect_velocity(int slot) const {
    // In slots; far enough for memory to answer. No value depends on it.
    constexpr int ahead = 24;
    if (slot + ahead >= points().slots()) return;
    const int cell = points().stencilled[slot + ahead].cell;
    if (!field().owns(cell)) return;
    ask_for(&velocity_[0][cell]);
    ask_for(&velocity_[1][cell]);
}

/// cells = B^T L, of the points of all ranks.
void ConstrainedFlow::spread_multipliers() {
    std::fill(cells_.begin(), cells_.end(), PlaneVector{});
    BoundaryOperator(points()).spread(multipliers_.values.data(), cells_.data());
    border_sums_.sum(field(), border_, cells_.data());
}

}  // namespace turbidite
