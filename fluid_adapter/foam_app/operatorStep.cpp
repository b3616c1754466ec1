// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/operatorStep.hpp"

#include <cmath>

#include "fluid_adapter/foam_app/advection.hpp"
#include "fluid_adapter/foam_app/boundaryForce.hpp"

namespace turbidite {
namespace {

/// All faces, internal faces first, then patch by patch.
void append_faces(const Foam::surfaceScalarField& field, std::vector<double>& values) {
    values.insert(values.end(), field.primitiveField().begin(), field.primitiveField().end());
    for (const auto& side : field.boundaryField())
        values.insert(values.end(), side.begin(), side.end());
}

/// From what append_faces appended; returns what follows.
const double* take_faces(const double* next, Foam::surfaceScalarField& field) {
    for (double& value : field.primitiveFieldRef()) value = *next++;
    for (auto& side : field.boundaryFieldRef())
        for (double& value : side) value = *next++;
    return next;
}

}  // namespace

Projection OperatorStep::project() {
    fields_.interpolate_flux();
    const Foam::scalar divergence = projection_.project();
    return {{divergence, fields_.courant()}, pressure_force(fields_)};
}

double OperatorStep::largest_courant() const {
    return in_second_order_ ? SecondOrder::largest_courant : FluidStep::largest_courant();
}

/// In second order phi becomes the flux at the middle of the window.
std::vector<BoundaryForce> OperatorStep::transport(int parts) {
    const double dt = fields_.time.deltaTValue();
    std::vector<BoundaryForce> forces;
    if (!in_second_order_) {
        for (int part = 0; part < parts; ++part) forces.push_back(convect(dt / parts));
        return forces;
    }
    const Foam::surfaceScalarField flux(fields_.phi);
    if (second_order_.goes_on()) fields_.phi = 1.5 * flux - 0.5 * last_flux_;
    last_flux_ = flux;
    return second_order_.transport(*this, dt, parts);
}

BoundaryForce OperatorStep::diffuse() {
    const double dt = fields_.time.deltaTValue();
    return in_second_order_ ? second_order_.diffuse(*this, dt) : diffuse_implicitly(dt);
}

std::vector<VelocityValues> OperatorStep::velocity_values() {
    Foam::vectorField& U = fields_.U.primitiveFieldRef();
    static_assert(sizeof(Foam::vector) == 3 * sizeof(double), "a vector is three doubles");
    return {{U.data()->v_, 3 * static_cast<std::size_t>(U.size())}};
}

SideForce OperatorStep::convect(double dt) {
    const SideForce force = convective_force(fields_);
    advect(fields_, dt);
    return force;
}

SideForce OperatorStep::diffuse_implicitly(double dt) {
    viscosity_.solve(dt);
    return viscous_force(fields_);
}

bool OperatorStep::finite() {
    Foam::scalar sum = 0.0;
    for (const Foam::vector& u : fields_.U) sum += Foam::magSqr(u);
    Foam::reduce(sum, Foam::sumOp<Foam::scalar>());
    return std::isfinite(sum);
}

std::vector<double> OperatorStep::memory() {
    std::vector<double> values;
    append_faces(fields_.excess, values);
    if (!in_second_order_) return values;
    append_faces(last_flux_, values);
    second_order_.append_memory(*this, values);
    return values;
}

void OperatorStep::set_memory(const std::vector<double>& values) {
    const double* next = take_faces(values.data(), fields_.excess);
    if (!in_second_order_) return;
    next = take_faces(next, last_flux_);
    second_order_.set_memory(*this, next);
}

}  // namespace turbidite
