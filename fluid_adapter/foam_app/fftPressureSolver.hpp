// SPDX-License-Identifier: GPL-3.0-or-later
//
// The pressure problem on a uniform box, solved directly (linear_solvers/separable_solve.hpp): no
// matrix, no iterations, divergence left at rounding. Where no side fixes p, it is zero in the
// cell (0, 0), as with the matrix.
#pragma once

#include "fluid_adapter/foam_app/pressureSolver.hpp"
#include "fluid_adapter/foam_app/uniformBox.hpp"
#include "fluid_adapter/linear_solvers/separable_solve.hpp"

namespace turbidite {

class FftPressureSolver final : public PressureSolver {
 public:
    /// Throws NotSeparable.
    FftPressureSolver(Foam::volScalarField& p, const RankGroup& ranks);

    void solve(const Foam::scalarField& f, Foam::scalar tighter) override;
    Foam::tmp<Foam::surfaceScalarField> gradient_flux() const override;

 private:
    FftPressureSolver(Foam::volScalarField& p, const RankGroup& ranks, const UniformBox& box);
    FftPressureSolver(Foam::volScalarField& p, const RankGroup& ranks, const UniformBox& box,
                      const PlaneOperator& plane);

    Foam::volScalarField& p_;
    bool floating_;                         // no side fixes p
    Foam::scalar cell_volume_;              // [m3]
    Foam::surfaceScalarField conductance_;  // |S_f| over the distance of the centres [m]
    CellRows rows_;
    SeparableSolve separable_;
};

}  // namespace turbidite
