// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/operatorStep.hpp"

#include <cmath>

#include "fluid_adapter/foam_app/advection.hpp"

namespace turbidite {

FluxReport OperatorStep::project(MomentumLedger& ledger) {
    fields_.interpolate_flux();
    const Foam::scalar divergence = projection_.project();
    ledger.add_pressure();
    return {divergence, fields_.courant()};
}

void OperatorStep::transport(MomentumLedger& ledger, int parts) {
    for (int part = 0; part < parts; ++part) {
        ledger.add_convection(1.0 / parts);
        advect(fields_, fields_.time.deltaTValue() / parts);
    }
}

void OperatorStep::diffuse(MomentumLedger& ledger) {
    viscosity_.solve(fields_.time.deltaTValue());
    ledger.add_viscosity();
}

bool OperatorStep::finite() const {
    Foam::scalar sum = 0.0;
    for (const Foam::vector& u : fields_.U) sum += Foam::magSqr(u);
    Foam::reduce(sum, Foam::sumOp<Foam::scalar>());
    return std::isfinite(sum);
}

/// All faces, inner ones first, then patch by patch.
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
