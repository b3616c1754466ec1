// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/boxFluidStep.hpp"

#include <algorithm>
#include <cmath>

#include "fluid_adapter/foam_app/laplacianOperator.hpp"
#include "fluid_adapter/ranks/rank_rows.hpp"

namespace turbidite {
namespace {

/// The operator with the spacing of the mesh in metres.
PlaneOperator in_metres(PlaneOperator plane, const Foam::vector& box_size) {
    plane.x.spacing = box_size.x() / plane.x.cells;
    plane.y.spacing = box_size.y() / plane.y.cells;
    return plane;
}

BoxFluid box_fluid(FluidFields& fields, double limiter, const BoxCells& box) {
    const Foam::vector size = fields.mesh.bounds().span();
    return {in_metres(homogeneous_laplacian(fields.U, box).plane, size),
            in_metres(homogeneous_laplacian(fields.p, box).plane, size), fields.nu, limiter};
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

BoxFluidStep::BoxFluidStep(FluidFields& fields, double limiter, const BoxCells& box)
    : BoxFluidStep(fields, box_fluid(fields, limiter, box), box) {}

BoxFluidStep::BoxFluidStep(FluidFields& fields, const BoxFluid& fluid, const BoxCells& box)
    : fields_(fields),
      rows_(fields.ranks, box.cells[0], box.cells[1], box.place),
      step_(fluid, box_rows(fields.ranks, fluid.pressure, rows_)),
      floating_(fluid.pressure.x.has_zero_mode() && fluid.pressure.y.has_zero_mode()) {
    take_velocity();
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

void BoxFluidStep::load() {
    const Foam::vectorField& U = fields_.U.primitiveField();
    rows_.gather([&](int c) { return U[c].x(); }, step_.velocity(0));
    rows_.gather([&](int c) { return U[c].y(); }, step_.velocity(1));
}

void BoxFluidStep::store() {
    Foam::vectorField& U = fields_.U.primitiveFieldRef();
    rows_.scatter(step_.velocity(0), [&](int c, double x) { U[c].x() = x; });
    rows_.scatter(step_.velocity(1), [&](int c, double y) { U[c].y() = y; });
    fields_.U.correctBoundaryConditions();
}

BoxStep::Force BoxFluidStep::on_all_ranks(BoxStep::Force force) const {
    fields_.ranks.sum(force.data(), static_cast<int>(force.size()));
    return force;
}

Projection BoxFluidStep::project() {
    if (!rows_.in_cell_order()) load();
    const FluxReport report = step_.project(fields_.time.deltaTValue());
    double largest[] = {report.divergence, report.courant};
    fields_.ranks.max(largest, 2);
    return {{largest[0], largest[1]}, on_all_ranks(step_.pressure_force())};
}

std::vector<BoundaryForce> BoxFluidStep::transport(int parts) {
    std::vector<BoundaryForce> forces;
    if (parts > 1) step_.hold_flux();
    for (int part = 0; part < parts; ++part) {
        forces.push_back(on_all_ranks(step_.convective_force()));
        step_.transport(fields_.time.deltaTValue() / parts);
    }
    step_.release_flux();
    return forces;
}

BoundaryForce BoxFluidStep::diffuse() {
    step_.diffuse(fields_.time.deltaTValue(), [](int) {});
    if (!rows_.in_cell_order()) store();
    return on_all_ranks(step_.viscous_force());
}

/// A direct solve spreads one bad value over all rows of all ranks.
bool BoxFluidStep::finite() {
    double sum = 0.0;
    const int some = std::min(rows_.size(), 100);
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
    std::vector<double> values = step_.excess(0);
    values.insert(values.end(), step_.excess(1).begin(), step_.excess(1).end());
    return values;
}

void BoxFluidStep::set_memory(const std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(step_.excess(0).size());
    std::copy(values.begin(), middle, step_.excess(0).begin());
    std::copy(middle, values.end(), step_.excess(1).begin());
    const Foam::scalarField& p = fields_.p.primitiveField();
    rows_.gather([&](int c) { return p[c]; }, step_.pressure());
}

}  // namespace turbidite
