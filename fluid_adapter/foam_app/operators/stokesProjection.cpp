// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/operators/stokesProjection.hpp"

#include <fvcFlux.H>
#include <fvcGrad.H>
#include <fvmLaplacian.H>

#include <algorithm>
#include <string>

#include "coupler/protocol/failure.hpp"

namespace turbidite {
namespace {

/// Divergence below this fraction of the goal is rounding, for which no pressure is solved.
constexpr Foam::scalar rounding = 1e-7;

/// The solver's tolerance is a mean over cells, the goal a maximum: it is tightened up to this many
/// times.
constexpr int attempts = 4;

/// Iterations continue from the present solution, so a small reduction costs little.
Foam::scalar tightening(Foam::scalar goal, Foam::scalar divergence) {
    // Aims at half of the goal, by a hundredth at most and by a half at least.
    return std::clamp(0.5 * goal / divergence, 0.01, 0.5);
}

}  // namespace

StokesProjection::StokesProjection(FluidFields& fields, Foam::scalar goal)
    : fields_(fields),
      goal_(goal),
      matrix_(Foam::fvm::laplacian(fields.p)),
      controls_(fields.mesh.solverDict(fields.p.name())),
      given_("givenPhi", fields.phi) {
    fields.mesh.setFluxRequired(fields.p.name());
    // If no side fixes p, it is fixed in one cell on one rank.
    matrix_.setReference(Foam::Pstream::master() ? 0 : -1, 0.0);
    solver_ = matrix_.solver(controls_);
}

/// Solves with the solver's tolerance multiplied by `tighter`, at most one.
void StokesProjection::solve_pressure(Foam::scalar tighter) {
    matrix_.source() = rate_;
    Foam::dictionary controls(controls_);
    controls.set("tolerance", tighter * controls_.get<Foam::scalar>("tolerance"));
    const Foam::solverPerformance result = solver_->solve(controls);
    if (!result.converged())
        throw PhysicsRefused("the pressure solver " + result.solverName() + " stopped after " +
                             std::to_string(result.nIterations()) + " iterations at residual " +
                             std::to_string(result.finalResidual()));
}

Foam::scalar StokesProjection::project() {
    // S.u + k e
    fields_.phi += kept_share() * fields_.excess;
    fields_.divergence(rate_);
    Foam::scalar divergence = Foam::gMax(Foam::mag(rate_)());
    if (divergence <= rounding * goal_) {
        fields_.p = Foam::dimensionedScalar(fields_.p.dimensions(), Foam::Zero);
        remember();
        return divergence;
    }
    given_ = fields_.phi;
    const Foam::dimensionedScalar dt = fields_.time.deltaT();
    // (div phi)/dt over a cell: the source of laplacian(p), integrated as the matrix is
    rate_ *= fields_.mesh.V().field() / dt.value();
    Foam::scalar tighter = 1.0;
    for (int attempt = 0; attempt < attempts; ++attempt) {
        solve_pressure(tighter);
        // phi1 = phi - dt S.grad p, with the differences of the matrix: div phi1 is dt times what
        // the solver leaves of the residual.
        fields_.phi = given_ - dt * matrix_.flux();
        divergence = fields_.largest_divergence();
        if (divergence <= goal_) break;
        tighter *= tightening(goal_, divergence);
    }
    // u1 = u - dt grad p
    fields_.U -= dt * Foam::fvc::grad(fields_.p);
    fields_.U.correctBoundaryConditions();
    remember();
    return divergence;
}

/// With h of the smallest cells, which are those of a mesh that is not stretched.
Foam::scalar StokesProjection::kept_share() const {
    const Foam::scalar area = Foam::gMin(fields_.mesh.V().field()) / fields_.thickness;
    return 1.0 / (1.0 + 4.0 * fields_.nu * fields_.time.deltaTValue() / area);
}

void StokesProjection::remember() {
    // e = phi1 - S.u1
    fields_.excess = fields_.phi - Foam::fvc::flux(fields_.U);
    // e is zero on the sides of the box, where the flux is given by boundary conditions.
    forAll(fields_.excess.boundaryField(), patch) {
        auto& side = fields_.excess.boundaryFieldRef()[patch];
        if (!side.coupled()) side = 0.0;
    }
}

}  // namespace turbidite
