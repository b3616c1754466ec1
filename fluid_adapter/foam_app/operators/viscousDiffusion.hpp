// SPDX-License-Identifier: GPL-3.0-or-later
//
// Step 3, viscosity, implicit: (u3 - u2)/dt = nu laplacian(u3), with OpenFOAM's matrix, which is
// reassembled if dt or a value held on a side changes, and the solver that fvSolution names.
#pragma once

#include <fvMatrices.H>

#include <memory>

#include "fluid_adapter/foam_app/fields/createFields.hpp"

namespace turbidite {

class ViscousDiffusion {
 public:
    explicit ViscousDiffusion(FluidFields& fields) : fields_(fields) {}

    /// Advances u2 to u3 over dt [s]. Throws PhysicsRefused if the solver does not converge.
    void solve(Foam::scalar dt);

    /// nu laplacian(u) [m/s2]
    Foam::tmp<Foam::vectorField> acceleration() const;

    /// Values that U holds on sides, which are part of the matrix, were changed.
    void forget_sides() { assembled_for_ = 0.0; }

 private:
    void assemble(Foam::scalar dt);

    FluidFields& fields_;
    Foam::scalar assembled_for_ = 0.0;
    std::unique_ptr<Foam::fvVectorMatrix> matrix_;
};

}  // namespace turbidite
