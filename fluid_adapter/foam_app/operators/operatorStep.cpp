// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/operators/operatorStep.hpp"

#include <algorithm>
#include <cmath>

#include "fluid_adapter/box_step/transport/transport_parts.hpp"
#include "fluid_adapter/foam_app/operators/advection.hpp"
#include "fluid_adapter/foam_app/operators/boundaryForce.hpp"

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
    // S.u; the projection adds k e.
    fields_.interpolate_flux();
    const Foam::scalar divergence = projection_.project();
    return {{divergence, fields_.courant(), carried_courant()}, pressure_force(fields_)};
}

/// Half a window beyond phi1, from the last window's; in the first window phi1 itself.
Foam::surfaceScalarField OperatorStep::flux_of_the_middle() const {
    if (!second_order_.goes_on()) return fields_.phi;
    return 1.5 * fields_.phi - 0.5 * last_flux_;
}

double OperatorStep::carried_courant() {
    if (!in_second_order_ || !second_order_.goes_on()) return fields_.courant();
    const Foam::surfaceScalarField flux(fields_.phi);
    fields_.phi = flux_of_the_middle();
    const double courant = fields_.courant();
    fields_.phi = flux;
    return courant;
}

TransportParts OperatorStep::parts(double courant) const {
    if (!in_second_order_) return {transport_parts(courant)};
    return SecondOrder::parts(courant / largest_courant_,
                              fastest_decay(fields_.time.deltaTValue()));
}

/// 2 nu dt sum(|S|/d)/V, the sum over the faces to other cells: on a box nu dt (4/hx2 + 4/hy2).
double OperatorStep::fastest_decay(double dt) const {
    const Foam::fvMesh& mesh = fields_.mesh;
    const Foam::surfaceScalarField::Internal& area = mesh.magSf();
    const Foam::surfaceScalarField::Internal& per_distance = mesh.nonOrthDeltaCoeffs();
    Foam::scalarField sum(mesh.nCells(), Foam::Zero);
    forAll(area, face) {
        const Foam::scalar one = area[face] * per_distance[face];
        sum[mesh.owner()[face]] += one;
        sum[mesh.neighbour()[face]] += one;
    }
    return 2.0 * fields_.nu * dt * Foam::gMax(Foam::scalarField(sum / mesh.V()));
}

/// In second order phi becomes the flux at the middle of the window.
std::vector<BoundaryForce> OperatorStep::transport(const TransportParts& parts) {
    const double dt = fields_.time.deltaTValue();
    viscous_transport_ = parts.viscous;
    std::vector<BoundaryForce> forces;
    if (!in_second_order_) {
        for (int part = 0; part < parts.count; ++part) forces.push_back(convect(dt / parts.count));
        return forces;
    }
    const Foam::surfaceScalarField flux(fields_.phi);
    fields_.phi = flux_of_the_middle();
    last_flux_ = flux;
    return second_order_.transport(*this, dt, parts);
}

BoundaryForce OperatorStep::diffuse() {
    // Viscosity was part of the stages, and so are the forces.
    if (viscous_transport_) return {};
    const double dt = fields_.time.deltaTValue();
    return in_second_order_ ? second_order_.diffuse(*this, dt) : diffuse_implicitly(dt);
}

std::vector<VelocityValues> OperatorStep::velocity_values() {
    Foam::vectorField& U = fields_.U.primitiveFieldRef();
    static_assert(sizeof(Foam::vector) == 3 * sizeof(double), "a vector is three doubles");
    // All three components: the third is zero and stays so (advection.cpp).
    return {{U.data()->v_, 3 * static_cast<std::size_t>(U.size())}};
}

SideForce OperatorStep::convect(double dt) {
    const SideForce force = convective_force(fields_);
    advect(fields_, dt);
    return force;
}

/// U holds u while OpenFOAM's operators work on it, and what it held afterwards.
SideForce OperatorStep::play(const VelocityStage& stage) {
    Foam::vectorField& U = fields_.U.primitiveFieldRef();
    const Foam::vectorField kept(U);
    const std::size_t size = 3 * static_cast<std::size_t>(U.size());
    double* const values = U.data()->v_;
    std::copy_n(stage.u[0], size, values);
    velocity_changed();
    const SideForce force = advance(stage.dt, stage.viscous);
    const std::vector<double> fresh(values, values + size);  // u + dt L(u)
    U = kept;
    for (std::size_t i = 0; i < size; ++i)
        stage.result[0][i] = stage.old * stage.v[0][i] + stage.fresh * fresh[i] +
                             stage.rate * (stage.now[0][i] - stage.before[0][i]);
    if (!stage.copy.empty()) std::copy_n(stage.result[0], size, stage.copy[0]);
    velocity_changed();
    return force;
}

/// U += dt L(U)
SideForce OperatorStep::advance(double dt, bool viscous) {
    if (!viscous) return convect(dt);
    // Both parts of L by the same u, before U changes
    SideForce force = viscous_force(fields_);
    const Foam::vectorField change(dt * viscosity_.acceleration());
    const SideForce convected = convect(dt);
    for (int axis = 0; axis < 2; ++axis) force[axis] += convected[axis];
    fields_.U.primitiveFieldRef() += change;
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
    // In OpenFOAM's order of faces, which is that of this decomposition: memory_rows stays empty.
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
