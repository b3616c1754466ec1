// SPDX-License-Identifier: GPL-3.0-or-later
//
// Step 3, viscosity, implicit: (u3 - u2)/dt = nu laplacian(u3). The problem stands behind one door,
// so that a direct solver can stand in for OpenFOAM's iterative ones.
#pragma once

#include <fvMatrices.H>

#include <memory>

#include "fluid_adapter/foam_app/createFields.hpp"

namespace turbidite {

class ViscousSolver {
 public:
    virtual ~ViscousSolver() = default;

    /// From u2 to u3, in the U the solver was made with.
    virtual void solve(Foam::scalar dt) = 0;
};

/// With OpenFOAM's matrix, assembled when dt changes, and the solver that fvSolution names.
class MatrixViscousSolver final : public ViscousSolver {
 public:
    MatrixViscousSolver(Foam::volVectorField& U, Foam::scalar nu) : U_(U), nu_(nu) {}

    void solve(Foam::scalar dt) override;

 private:
    void assemble(Foam::scalar dt);

    Foam::volVectorField& U_;
    Foam::scalar nu_;
    Foam::scalar assembled_for_ = 0.0;
    std::unique_ptr<Foam::fvVectorMatrix> matrix_;
};

}  // namespace turbidite
