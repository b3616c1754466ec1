// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/boxFluidStep.hpp"

#include <algorithm>
#include <cmath>

namespace turbidite {

BoxFluidStep::BoxFluidStep(FluidFields& fields, double limiter)
    : fields_(fields),
      box_(uniform_box(fields.mesh)),
      step_({plane_operator(fields.U), plane_operator(fields.p), fields.nu, limiter}),
      floating_(plane_operator(fields.p).x.has_zero_mode() &&
                plane_operator(fields.p).y.has_zero_mode()) {}

void BoxFluidStep::load() {
    double *x = step_.velocity(0), *y = step_.velocity(1);
    const Foam::vectorField& U = fields_.U.primitiveField();
    const Foam::label cells = U.size();
    for (Foam::label c = 0; c < cells; ++c) {
        x[c] = U[c].x();
        y[c] = U[c].y();
    }
}

void BoxFluidStep::store_row(int j) {
    const Foam::label first = j * box_.cells[0], end = first + box_.cells[0];
    const double *x = step_.velocity(0), *y = step_.velocity(1);
    Foam::vectorField& U = fields_.U.primitiveFieldRef();
    for (Foam::label c = first; c < end; ++c) U[c] = Foam::vector(x[c], y[c], 0.0);
}

FluxReport BoxFluidStep::project(MomentumLedger& ledger) {
    load();
    const FluxReport report = step_.project(fields_.time.deltaTValue());
    ledger.add(step_.pressure_force());
    return report;
}

void BoxFluidStep::transport(MomentumLedger& ledger) {
    ledger.add(step_.convective_force());
    step_.transport(fields_.time.deltaTValue());
}

void BoxFluidStep::diffuse(MomentumLedger& ledger) {
    step_.diffuse(fields_.time.deltaTValue(), [this](int j) { store_row(j); });
    fields_.U.correctBoundaryConditions();
    ledger.add(step_.viscous_force());
}

/// A direct solve spreads one bad value over all rows.
bool BoxFluidStep::finite() const {
    Foam::scalar sum = 0.0;
    for (int i = 0; i < box_.cells[0]; ++i) sum += Foam::magSqr(fields_.U[i]);
    return std::isfinite(sum);
}

/// Calls visit(value, e, area, remembered) for every face of excess: its value there, in the step,
/// the area with the sign that turns one into the other, and false on the sides of the box.
template <class Visit>
void BoxFluidStep::for_faces(Visit visit) {
    const int nx = box_.cells[0];
    const double area[2] = {box_.spacing[1] * fields_.thickness,
                            box_.spacing[0] * fields_.thickness};
    const auto place = [&](Foam::label cell, int axis, int beyond) -> double& {
        const std::size_t i = cell % nx, j = cell / nx;
        return axis == 0 ? step_.excess(0)[j * (nx + 1) + i + beyond]
                         : step_.excess(1)[(j + beyond) * nx + i];
    };
    const Foam::labelUList& owner = fields_.mesh.owner();
    const Foam::labelUList& neighbour = fields_.mesh.neighbour();
    Foam::scalarField& inner = fields_.excess.primitiveFieldRef();
    forAll(inner, face) {
        const int axis = neighbour[face] == owner[face] + 1 ? 0 : 1;
        visit(inner[face], place(owner[face], axis, 1), area[axis], true);
    }
    for (int side = 0; side < 4; ++side) {
        auto& values = fields_.excess.boundaryFieldRef()[box_.patches[side]];
        const Foam::labelUList& cells = values.patch().faceCells();
        const int axis = side / 2, upper = side % 2;
        forAll(values, face) visit(values[face], place(cells[face], axis, upper),
                                   upper ? area[axis] : -area[axis], values.coupled());
    }
}

void BoxFluidStep::put_fields() {
    Foam::scalarField& p = fields_.p.primitiveFieldRef();
    const double* values = step_.pressure();
    const double level = floating_ ? values[0] : 0.0;
    forAll(p, c) p[c] = values[c] - level;
    fields_.p.correctBoundaryConditions();
    for_faces([](double& value, double& e, double area, bool remembered) {
        value = remembered ? area * e : 0.0;
    });
}

void BoxFluidStep::take_fields() {
    for_faces([](double& value, double& e, double area, bool remembered) {
        e = remembered ? value / area : 0.0;
    });
    double* p = step_.pressure();
    std::copy(fields_.p.begin(), fields_.p.end(), p);
}

}  // namespace turbidite
