// SPDX-License-Identifier: GPL-3.0-or-later
//
// The viscous step on a uniform box, solved directly (linear_solvers/separable_solve.hpp): one
// factorisation for both components of u, made when dt changes.
#pragma once

#include "fluid_adapter/foam_app/uniformBox.hpp"
#include "fluid_adapter/foam_app/viscousDiffusion.hpp"
#include "fluid_adapter/linear_solvers/separable_solve.hpp"

namespace turbidite {

class FftViscousSolver final : public ViscousSolver {
 public:
    /// Throws NotSeparable.
    FftViscousSolver(Foam::volVectorField& U, Foam::scalar nu, const RankGroup& ranks);

    void solve(Foam::scalar dt) override;

 private:
    FftViscousSolver(Foam::volVectorField& U, Foam::scalar nu, const RankGroup& ranks,
                     const UniformBox& box);

    Foam::volVectorField& U_;
    Foam::scalar nu_;
    Foam::scalar factorised_for_ = 0.0;
    CellRows rows_;
    SeparableSolve separable_;
};

}  // namespace turbidite
