// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Viscosity of a fluid with rigid grains, implicit in time: with s the velocity without it and W of
// rigid_grains.hpp (affine here: momenta of grains included)
//
//     u = W(s + f),    f = dt nu L u
//
// by conjugate gradients on the viscous impulse f: the residual r = dt nu L u - f, preconditioned
// by W itself, needs no transforms, and every iterate u is rigid. The operator I - dt nu L W has
// eigenvalues from 1 to 1 + 8 nu dt/h2. Valid C++17.
#pragma once

#include "fluid_adapter/coupled_step/conjugate_directions.hpp"
#include "fluid_adapter/coupled_step/rigid_grains.hpp"

namespace turbidite {

class RigidViscosity {
 public:
    /// Begins a window: `per_laplacian` is nu dt [m2], f = dt nu L u of this velocity.
    void begin(BoxOperators& box, double per_laplacian, const CellVelocity& velocity);

    /// Corrects the window's velocity and f until |r| < tolerance max(|f|, |r|), the maximum at the
    /// beginning.
    IterationResult correct(BoxOperators& box, RigidGrains& grains, const IterationLimit& limit);

    /// f over the rank's cells [m/s].
    const RowsOfTwo& impulse() const { return impulse_; }

 private:
    double find_residual(BoxOperators& box, const RigidGrains& grains);
    void choose_direction(RigidGrains& grains, bool first, double& rz, const IterationLimit& limit);
    ImageProducts apply(BoxOperators& box, const RigidGrains& grains, bool keep);
    void move(RigidGrains& grains, double alpha, bool again);

    double per_laplacian_ = 0.0;
    double scale_ = 0.0;  // |f|^2, or |r|^2 if that is larger
    RowsOfTwo impulse_, residual_, image_;
    RowsOfTwo later_;                       // d of all iterations but the first, where it is r
    const RowsOfTwo* direction_ = nullptr;  // null: r
    RigidChange rigid_residual_, rigid_direction_;
};

}  // namespace turbidite
