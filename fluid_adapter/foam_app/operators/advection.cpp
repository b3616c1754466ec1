// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/operators/advection.hpp"

#include <fvcDiv.H>

namespace turbidite {

void advect(FluidFields& fields, Foam::scalar dt) {
    // In conservative form, with phi1 and the scheme that fvSchemes names for div(phi,U)
    const Foam::tmp<Foam::volVectorField> change =
        Foam::fvc::div(fields.phi, fields.U, "div(phi,U)");
    fields.U -= Foam::dimensionedScalar("dt", Foam::dimTime, dt) * change;
    // The third component would grow from rounding: nothing damps it, and the limiter acts on all.
    fields.U.replace(Foam::vector::Z, Foam::dimensionedScalar(Foam::dimVelocity, Foam::Zero));
    fields.U.correctBoundaryConditions();
}

}  // namespace turbidite
