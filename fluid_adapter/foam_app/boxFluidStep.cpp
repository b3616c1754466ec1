// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/boxFluidStep.hpp"

#include <algorithm>
#include <cmath>

#include "fluid_adapter/box_step/transport_parts.hpp"
#include "fluid_adapter/foam_app/laplacianOperator.hpp"
#include "fluid_adapter/foam_app/sideVelocity.hpp"
#include "fluid_adapter/ranks/rank_rows.hpp"

namespace turbidite {
namespace {

/// The operator with the spacing of the mesh in metres; of a stretched grid, that of its first row.
PlaneOperator in_metres(PlaneOperator plane, const Foam::vector& box_size, const CellGrid& grid) {
    plane.x.spacing = box_size.x() / plane.x.cells;
    plane.y.spacing = box_size.y() / plane.y.cells;
    plane.y.sizes.clear();
    for (int j = 0; grid.stretched(1) && j < plane.y.cells; ++j)
        plane.y.sizes.push_back(grid.size(1, j));
    if (plane.y.stretched()) plane.y.spacing = grid.size(1, 0);
    return plane;
}

/// OpenFOAM's operators do as the case says; rows of different heights know one interpolation.
void demand_volume_weights(const Foam::fvMesh& mesh, const CellGrid& grid) {
    if (grid.stretched(1) && Foam::word(mesh.interpolationScheme("flux(U)")) != "reverseLinear")
        throw DoesNotFit("with rows of different heights interpolation must be reverseLinear");
}

BoxFluid box_fluid(FluidFields& fields, const TransportMethod& method, const BoxCells& box,
                   const CellGrid& grid) {
    demand_volume_weights(fields.mesh, grid);
    const Foam::vector size = fields.mesh.bounds().span();
    return {in_metres(laplacian_with_values(fields.U, box).plane, size, grid),
            in_metres(homogeneous_laplacian(fields.p, box).plane, size, grid),
            fields.nu,
            method.limiter,
            method.central,
            method.second_order};
}

std::unique_ptr<BoxRows> box_rows(const RankGroup& ranks, const PlaneOperator& plane,
                                  const CellRows& cells) {
    if (!ranks.parallel()) return std::make_unique<AllRows>(plane);
    try {
        return std::make_unique<RankRows>(ranks, plane, cells);
    } catch (const std::invalid_argument& why) {
        throw DoesNotFit(why.what());
    }
}

}  // namespace

BoxFluidStep::BoxFluidStep(FluidFields& fields, const TransportMethod& method, const BoxCells& box,
                           const CellGrid& grid)
    : BoxFluidStep(fields, box_fluid(fields, method, box, grid), box, method.coupled) {}

BoxFluidStep::BoxFluidStep(FluidFields& fields, const BoxFluid& fluid, const BoxCells& box,
                           bool coupled)
    : fields_(fields),
      box_(box),
      rows_(fields.ranks, box.cells[0], box.cells[1], box.place),
      step_(fluid, box_rows(fields.ranks, fluid.pressure, rows_)),
      in_second_order_(fluid.second_order),
      largest_courant_(SecondOrder::largest_courant(fluid.central)),
      floating_(fluid.pressure.x.has_zero_mode() && fluid.pressure.y.has_zero_mode()),
      first_row_(rows_.rows_of_rank()[fields.ranks.rank()].first) {
    if (coupled && !rows_.in_cell_order())
        throw DoesNotFit("its ranks do not have complete rows of cells");
    if (coupled) coupled_.emplace(step_);
    take_velocity();
    sides_changed();
}

double* BoxFluidStep::velocity(int axis) {
    return rows_.in_cell_order() ? step_.velocity(axis) : nullptr;
}

void BoxFluidStep::put_velocity() {
    if (rows_.in_cell_order()) store();
}

void BoxFluidStep::take_velocity() {
    if (rows_.in_cell_order()) load();
}

void BoxFluidStep::sides_changed() {
    const std::array<SideValues, 2> held = held_on_sides(fields_, box_);
    for (int axis = 0; axis < 2; ++axis)
        for (int side = 0; side < 4; ++side) {
            std::vector<double>& own = step_.side_velocity(axis)[side];
            std::copy_n(held[axis][side].begin() + (side < 2 ? first_row_ : 0), own.size(),
                        own.begin());
        }
}

void BoxFluidStep::load() {
    const Foam::vectorField& U = fields_.U.primitiveField();
    rows_.gather([&](int c) { return U[c].x(); }, step_.velocity(0));
    rows_.gather([&](int c) { return U[c].y(); }, step_.velocity(1));
}

void BoxFluidStep::store() {
    store(step_.velocity(0), step_.velocity(1));
}

void BoxFluidStep::put_unconstrained() {
    if (!coupled_) return put_velocity();
    const RowsOfTwo s = coupled_->unconstrained();
    store(s.x.data(), s.y.data());
}

void BoxFluidStep::store(const double* x_rows, const double* y_rows) {
    Foam::vectorField& U = fields_.U.primitiveFieldRef();
    rows_.scatter(x_rows, [&](int c, double x) { U[c].x() = x; });
    rows_.scatter(y_rows, [&](int c, double y) { U[c].y() = y; });
    fields_.U.correctBoundaryConditions();
}

BoxStep::Force BoxFluidStep::on_all_ranks(BoxStep::Force force) const {
    fields_.ranks.sum(force.data(), static_cast<int>(force.size()));
    return force;
}

/// Holds the flux of transport, where it is not phi1.
FluxReport BoxFluidStep::project(double dt) {
    const bool begins = !second_order_.goes_on();
    if (in_second_order_ && !coupled_) return step_.project_and_hold_middle(dt, begins);
    if (!coupled_) return step_.project(dt);
    const FluxReport report = step_.hold_solenoidal_flux(dt);
    if (in_second_order_) step_.hold_middle_flux(begins);
    return report;
}

Projection BoxFluidStep::project() {
    if (!rows_.in_cell_order()) load();
    const double dt = fields_.time.deltaTValue();
    const FluxReport report = project(dt);
    double largest[] = {report.divergence, report.courant};
    fields_.ranks.max(largest, 2);
    const BoxStep::Force none{};
    return {{largest[0], largest[1]}, coupled_ ? none : on_all_ranks(step_.pressure_force())};
}

/// Where pressure and viscosity know the grains, transport leaves viscosity to them.
TransportParts BoxFluidStep::parts(double courant) const {
    if (!in_second_order_) return {transport_parts(courant)};
    const double decay = step_.fastest_decay(fields_.time.deltaTValue());
    return SecondOrder::parts(courant / largest_courant_, coupled_ ? INFINITY : decay);
}

std::vector<BoundaryForce> BoxFluidStep::transport(const TransportParts& parts) {
    std::vector<BoundaryForce> forces =
        in_second_order_ ? transport_in_second_order(parts) : transport_in_first_order(parts.count);
    for (BoundaryForce& force : forces) force = on_all_ranks(force);
    viscous_transport_ = parts.viscous;
    step_.release_flux();
    return forces;
}

std::vector<BoundaryForce> BoxFluidStep::transport_in_second_order(const TransportParts& parts) {
    const double dt = fields_.time.deltaTValue();
    std::vector<BoundaryForce> forces = second_order_.transport(*this, dt, parts);
    if (coupled_) step_.add_impulses(second_order_.transported(), coupled_->begin(dt));
    return forces;
}

std::vector<BoundaryForce> BoxFluidStep::transport_in_first_order(int parts) {
    const double dt = fields_.time.deltaTValue();
    if (parts > 1 && !step_.holds_flux()) step_.hold_flux();
    ImpulsesOfWindow* impulses = coupled_ ? &coupled_->begin(dt) : nullptr;
    std::vector<BoundaryForce> forces;
    for (int part = 1; part <= parts; ++part)
        forces.push_back(convect(dt / parts, part == parts ? impulses : nullptr));
    return forces;
}

BoundaryForce BoxFluidStep::diffuse() {
    if (coupled_) {
        coupled_->keep_transported();
        return {};
    }
    const double dt = fields_.time.deltaTValue();
    BoundaryForce force{};
    if (!in_second_order_) force = diffuse_implicitly(dt);
    if (in_second_order_ && !viscous_transport_) force = second_order_.diffuse(*this, dt);
    if (!rows_.in_cell_order()) store();
    return on_all_ranks(force);
}

std::vector<BoundaryForce> BoxFluidStep::end_coupled() {
    if (!coupled_) return {};
    coupled_->end();
    return {on_all_ranks(step_.pressure_force()), on_all_ranks(coupled_->viscous_force())};
}

std::vector<VelocityValues> BoxFluidStep::velocity_values() {
    const auto size = static_cast<std::size_t>(rows_.size());
    return {{step_.velocity(0), size}, {step_.velocity(1), size}};
}

SideForce BoxFluidStep::convect(double dt, ImpulsesOfWindow* impulses) {
    const SideForce force = step_.convective_force();
    step_.transport(dt, impulses);
    return force;
}

SideForce BoxFluidStep::diffuse_implicitly(double dt) {
    step_.diffuse(dt, [](int) {});
    return step_.viscous_force();
}

/// A direct solve spreads one bad value over all rows of all ranks; without one, all cells count.
bool BoxFluidStep::finite() {
    double sum = 0.0;
    const int some = coupled_ ? rows_.size() : std::min(rows_.size(), 100);
    for (int axis = 0; axis < 2; ++axis)
        for (int c = 0; c < some; ++c) sum += std::abs(step_.velocity(axis)[c]);
    return fields_.ranks.all(std::isfinite(sum));
}

void BoxFluidStep::put_pressure() {
    Foam::scalarField& p = fields_.p.primitiveFieldRef();
    const double level = floating_ ? rows_.first(step_.pressure()) : 0.0;
    rows_.scatter(step_.pressure(), [&](int c, double value) { p[c] = value - level; });
    fields_.p.correctBoundaryConditions();
}

std::vector<double> BoxFluidStep::memory() {
    std::vector<double> values;
    const auto append = [&](const std::vector<double>& more) {
        values.insert(values.end(), more.begin(), more.end());
    };
    for (int axis = 0; axis < 2; ++axis) append(step_.excess(axis));
    // The next window begins with p itself: the field has another level where no side fixes it.
    if (coupled_) values.insert(values.end(), step_.pressure(), step_.pressure() + rows_.size());
    if (!in_second_order_) return values;
    for (int axis = 0; axis < 2; ++axis) append(step_.last_flux(axis));
    second_order_.append_memory(*this, values);
    return values;
}

void BoxFluidStep::set_memory(const std::vector<double>& values) {
    const double* next = values.data();
    const auto take = [&](double* to, std::size_t size) {
        std::copy_n(next, size, to);
        next += size;
    };
    const auto take_flux = [&](std::vector<double>& to) { take(to.data(), to.size()); };
    for (int axis = 0; axis < 2; ++axis) take_flux(step_.excess(axis));
    const Foam::scalarField& p = fields_.p.primitiveField();
    rows_.gather([&](int c) { return p[c]; }, step_.pressure());
    if (coupled_) take(step_.pressure(), rows_.size());
    if (!in_second_order_) return;
    for (int axis = 0; axis < 2; ++axis) take_flux(step_.last_flux(axis));
    second_order_.set_memory(*this, next);
}

/// As `memory` appends them.
MemoryRows BoxFluidStep::memory_rows() const {
    const std::size_t nx = static_cast<std::size_t>(box_.cells[0]);
    const MemoryRows::Array cells{nx, 0}, single{};
    const std::vector<MemoryRows::Array> flux{{nx + 1, 0}, {nx, 1}};
    MemoryRows rows{static_cast<std::size_t>(first_row_),
                    static_cast<std::size_t>(rows_.size()) / nx, flux};
    const auto append = [&](const std::vector<MemoryRows::Array>& more) {
        rows.arrays.insert(rows.arrays.end(), more.begin(), more.end());
    };
    if (coupled_) append({cells});
    if (in_second_order_) append(flux), append({single, cells, cells});
    return rows;
}

}  // namespace turbidite
