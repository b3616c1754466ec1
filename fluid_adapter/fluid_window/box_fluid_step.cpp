// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/fluid_window/box_fluid_step.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fluid_adapter/box_step/transport/transport_parts.hpp"

namespace turbidite {
BoxFluidStep::BoxFluidStep(const BoxFluid& fluid, std::unique_ptr<BoxRows> rows,
                           std::unique_ptr<RowFields> fields, const RankGroup& ranks, bool coupled)
    : fields_(std::move(fields)),
      ranks_(ranks),
      step_(fluid, std::move(rows)),
      in_second_order_(fluid.second_order),
      largest_courant_(SecondOrder::largest_courant(fluid.central)),
      floating_(fluid.pressure.has_zero_mode()) {
    if (coupled) coupled_.emplace(step_);
    take_velocity();
    sides_changed();
}

double* BoxFluidStep::velocity(int axis) {
    return fields_->stay_in_rows() ? step_.velocity(axis) : nullptr;
}

VelocityPointers BoxFluidStep::components() {
    VelocityPointers u(step_.layers().components());
    for (int axis = 0; axis < u.size(); ++axis) u[axis] = step_.velocity(axis);
    return u;
}

void BoxFluidStep::put_velocity() {
    if (fields_->stay_in_rows()) store();
}

void BoxFluidStep::take_velocity() {
    if (fields_->stay_in_rows()) load();
}

void BoxFluidStep::sides_changed() {
    const VelocityOnSides held = fields_->side_velocity();
    const BoxLayers& layers = step_.layers();
    // Per layer; those at bottom and top are of all ranks.
    const int per_layer[] = {layers.nz, 0, layers.nx};
    for (int axis = 0; axis < layers.components(); ++axis)
        for (int side = 0; side < 2 * layers.components(); ++side) {
            std::vector<double>& own = step_.side_velocity(axis)[side];
            // Of the whole side the part of this rank's layers
            std::copy_n(held[axis][side].begin() + per_layer[side / 2] * fields_->first_row(),
                        own.size(), own.begin());
        }
}

void BoxFluidStep::load() {
    fields_->read_velocity(components());
}

void BoxFluidStep::store() {
    fields_->write_velocity(components());
}

void BoxFluidStep::put_unconstrained() {
    if (!coupled_) return put_velocity();
    // There is no u3 of before the grains: s of the last f and p takes its place.
    VelocityRows s = coupled_->unconstrained();
    fields_->write_velocity(s.pointers());
}

BoxStep::Force BoxFluidStep::on_all_ranks(BoxStep::Force force) const {
    ranks_.sum(force.data(), static_cast<int>(force.size()));
    return force;
}

/// Holds the flux of transport, where it is not phi1.
FluxReport BoxFluidStep::solenoidal() {
    const bool begins = !second_order_.goes_on();
    if (in_second_order_ && !coupled_) return step_.project_and_hold_middle(dt_, begins);
    if (!coupled_) return step_.project(dt_);
    // Transport gets a flux without divergence; u^n, nearly solenoidal already, and e stay.
    return in_second_order_ ? step_.hold_solenoidal_middle(dt_, begins)
                            : step_.hold_solenoidal_flux(dt_);
}

/// What only transport needs is lent to pressure and viscosity until the next projection.
void BoxFluidStep::lend(bool lent) {
    if (!coupled_ || lent == lent_) return;
    coupled_->exchange_work(second_order_.idle_stages(), step_.idle_flux());
    lent_ = lent;
}

Projection BoxFluidStep::project() {
    lend(false);
    if (!fields_->stay_in_rows()) load();
    const FluxReport report = solenoidal();
    double largest[] = {report.divergence, report.courant, report.carried_courant};
    // All ranks cut transport into the same number of parts.
    ranks_.max(largest, 3);
    const BoxStep::Force none{};
    // With rigid grains p is found later: end_coupled tells its force.
    return {{largest[0], largest[1], largest[2]},
            coupled_ ? none : on_all_ranks(step_.pressure_force())};
}

/// Where pressure and viscosity know the grains, transport leaves viscosity to them.
TransportParts BoxFluidStep::parts(double courant) const {
    if (!in_second_order_) return {transport_parts(courant)};
    const double decay = step_.fastest_decay(dt_);
    // A decay without bound keeps viscosity out of the stages.
    return SecondOrder::parts(courant / largest_courant_, coupled_ ? INFINITY : decay);
}

std::vector<BoundaryForce> BoxFluidStep::transport(const TransportParts& parts) {
    std::vector<BoundaryForce> forces =
        in_second_order_ ? transport_in_second_order(parts) : transport_in_first_order(parts.count);
    for (BoundaryForce& force : forces) force = on_all_ranks(force);
    viscous_transport_ = parts.viscous;
    step_.release_flux();
    lend(true);
    return forces;
}

std::vector<BoundaryForce> BoxFluidStep::transport_in_second_order(const TransportParts& parts) {
    std::vector<BoundaryForce> forces = second_order_.transport(*this, dt_, parts);
    if (coupled_) step_.add_impulses(second_order_.transported(), coupled_->begin(dt_));
    return forces;
}

std::vector<BoundaryForce> BoxFluidStep::transport_in_first_order(int parts) {
    // A single part recomputes phi1 = S.u1 + e; later parts need it when u has changed.
    if (parts > 1 && !step_.holds_flux()) step_.hold_flux();
    ImpulsesOfWindow* impulses = coupled_ ? &coupled_->begin(dt_) : nullptr;
    std::vector<BoundaryForce> forces;
    for (int part = 1; part <= parts; ++part)
        // f and -dt G p^n once, with the last part
        forces.push_back(convect(dt_ / parts, part == parts ? impulses : nullptr));
    return forces;
}

BoundaryForce BoxFluidStep::diffuse() {
    if (coupled_) {
        // f, explicit, has come with transport, and `correct` makes it implicit.
        coupled_->keep_transported();
        return {};
    }
    BoundaryForce force{};
    if (!in_second_order_) force = diffuse_implicitly(dt_);
    if (in_second_order_ && !viscous_transport_) force = second_order_.diffuse(*this, dt_);
    if (!fields_->stay_in_rows()) store();
    return on_all_ranks(force);
}

std::vector<BoundaryForce> BoxFluidStep::end_coupled() {
    if (!coupled_) return {};
    coupled_->end();
    // Of the p and f that the window has ended with, as impulses over the whole of it
    return {on_all_ranks(step_.pressure_force()), on_all_ranks(coupled_->viscous_force())};
}

void BoxFluidStep::forget_pressure() {
    if (coupled_) std::fill_n(step_.pressure(), step_.cells(), 0.0);
}

std::vector<VelocityValues> BoxFluidStep::velocity_values() {
    std::vector<VelocityValues> values;
    for (double* u : components()) values.push_back({u, step_.cells()});
    return values;
}

SideForce BoxFluidStep::convect(double dt, ImpulsesOfWindow* impulses) {
    // With the u that is carried, before transport changes it
    const SideForce force = step_.convective_force();
    step_.transport(dt, impulses);
    return force;
}

SideForce BoxFluidStep::diffuse_implicitly(double dt) {
    step_.diffuse(dt, [](int) {});
    return step_.viscous_force();
}

/// A direct solve spreads one bad value over all rows of all ranks; with rigid grains there is
/// none, and all cells count, as transport has summed them. Nor is there one where transport has
/// done viscosity: a bad value beyond the first cells is then found by the ledger, after step 5.
bool BoxFluidStep::finite() {
    double sum = coupled_ ? coupled_->sum_of_transported() : 0.0;
    const std::size_t some = std::min<std::size_t>(step_.cells(), 100);
    for (const double* u : components())
        for (std::size_t c = 0; c < some; ++c) sum += std::abs(u[c]);
    return ranks_.all(std::isfinite(sum));
}

void BoxFluidStep::put_pressure() {
    fields_->write_pressure(step_.pressure(), floating_);
}

void BoxFluidStep::visit_memory(const ValuesVisit& visit) {
    const auto visit_all = [&](std::vector<double>& values) {
        visit(values.data(), values.size());
    };
    const int components = step_.layers().components();
    // This order is that of saved states (memory_rows); `kind` tells which parts there are.
    for (int axis = 0; axis < components; ++axis) visit_all(step_.excess(axis));
    // The next window begins with p itself: the field has another level where no side fixes it.
    if (coupled_) visit(step_.pressure(), step_.cells());
    if (!in_second_order_) return;
    for (int axis = 0; axis < components; ++axis) visit_all(step_.last_flux(axis));
    second_order_.visit_memory(*this, visit);
}

std::vector<double> BoxFluidStep::memory() {
    std::vector<double> values;
    visit_memory([&](const double* first, std::size_t count) {
        values.insert(values.end(), first, first + count);
    });
    return values;
}

void BoxFluidStep::set_memory(const std::vector<double>& values) {
    const double* next = values.data();
    take_pressure();
    visit_memory([&](double* first, std::size_t count) {
        std::copy_n(next, count, first);
        next += count;
    });
}

/// Of values on faces; there is a layer of faces more than of cells along y.
std::vector<MemoryRows::Array> BoxFluidStep::flux_rows() const {
    const BoxLayers& layers = step_.layers();
    std::vector<MemoryRows::Array> rows;
    for (int axis = 0; axis < layers.components(); ++axis)
        rows.push_back({layers.face_row(axis, 1, 0), axis == 1 ? 1u : 0u});
    return rows;
}

/// As `memory` appends them.
MemoryRows BoxFluidStep::memory_rows() const {
    const BoxLayers& layers = step_.layers();
    const MemoryRows::Array cells{layers.layer(), 0}, single{};
    const std::vector<MemoryRows::Array> flux = flux_rows();
    MemoryRows rows{static_cast<std::size_t>(fields_->first_row()),
                    static_cast<std::size_t>(layers.ny), flux};
    const auto append = [&](const std::vector<MemoryRows::Array>& more) {
        rows.arrays.insert(rows.arrays.end(), more.begin(), more.end());
    };
    if (coupled_) append({cells});
    const std::vector<MemoryRows::Array> velocity(layers.components(), cells);
    if (in_second_order_) append(flux), append({single}), append(velocity);
    return rows;
}

}  // namespace turbidite
