// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/advection.hpp"

#include <fvcDiv.H>

namespace turbidite {

void advect(FluidFields& fields, Foam::scalar dt) {
    const Foam::tmp<Foam::volVectorField> change =
        Foam::fvc::div(fields.phi, fields.U, "div(phi,U)");
    fields.U -= Foam::dimensionedScalar("dt", Foam::dimTime, dt) * change;
    fields.U.replace(Foam::vector::Z, Foam::dimensionedScalar(Foam::dimVelocity, Foam::Zero));
    fields.U.correctBoundaryConditions();
}

}  // namespace turbidite
