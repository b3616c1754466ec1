// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/operatorStep.hpp"

#include <cmath>

#include "fluid_adapter/foam_app/advection.hpp"
#include "fluid_adapter/foam_app/boundaryForce.hpp"

namespace turbidite {

Projection OperatorStep::project() {
    fields_.interpolate_flux();
    const Foam::scalar divergence = projection_.project();
    return {{divergence, fields_.courant()}, pressure_force(fields_)};
}

std::vector<BoundaryForce> OperatorStep::transport(int parts) {
    std::vector<BoundaryForce> forces;
    for (int part = 0; part < parts; ++part) {
        forces.push_back(convective_force(fields_));
        advect(fields_, fields_.time.deltaTValue() / parts);
    }
    return forces;
}

BoundaryForce OperatorStep::diffuse() {
    viscosity_.solve(fields_.time.deltaTValue());
    return viscous_force(fields_);
}

bool OperatorStep::finite() {
    Foam::scalar sum = 0.0;
    for (const Foam::vector& u : fields_.U) sum += Foam::magSqr(u);
    Foam::reduce(sum, Foam::sumOp<Foam::scalar>());
    return std::isfinite(sum);
}

/// The excess at all faces, internal faces first, then patch by patch.
std::vector<double> OperatorStep::memory() {
    const Foam::surfaceScalarField& excess = fields_.excess;
    std::vector<double> values(excess.primitiveField().begin(), excess.primitiveField().end());
    for (const auto& side : excess.boundaryField())
        values.insert(values.end(), side.begin(), side.end());
    return values;
}

void OperatorStep::set_memory(const std::vector<double>& values) {
    auto next = values.begin();
    for (double& value : fields_.excess.primitiveFieldRef()) value = *next++;
    for (auto& side : fields_.excess.boundaryFieldRef())
        for (double& value : side) value = *next++;
}

}  // namespace turbidite
