// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Viscosity of a fluid with rigid grains, implicit in time: with s the velocity without it and W of
// rigid_grains.hpp (affine here: momenta of grains included)
//
//     u = W(s + f),    f = dt nu L u
//
// by conjugate gradients on the viscous impulse f: the residual r = dt nu L u - f, preconditioned
// by W itself, needs no transforms, and every iterate u is rigid. The operator I - dt nu L W has
// eigenvalues from 1 to 1 + 8 nu dt/h2, in space 12. Valid C++17.
#pragma once

#include "fluid_adapter/box_step/box_step.hpp"
#include "fluid_adapter/coupled_step/conjugate_directions.hpp"
#include "fluid_adapter/coupled_step/rigid_grains.hpp"

namespace turbidite {

class RigidViscosity {
 public:
    explicit RigidViscosity(CorrectionWork& work) : work_(work) {}

    /// Begins a window of length dt [s] in a fluid of viscosity nu [m2/s]. Its f is to be set by
    /// the caller: that of the velocity it begins with.
    ImpulsesOfWindow& begin(double dt, double nu);

    double sum_of_transported() const { return window_.sum_u; }

    /// Corrects the window's velocity and f until the rms of r/dt is below the tolerance [m/s2].
    /// The last change of the velocity may be left pending.
    IterationResult correct(BoxOperators& box, RigidGrains& grains, const IterationLimit& limit);

    /// Between windows, for arrays that are idle from then on; whoever gives them has no use for
    /// what is in these.
    void exchange_residual(std::vector<std::vector<double>>& rows) { residual_.swap(rows); }

    /// f over the rank's cells [m/s].
    const VelocityRows& impulse();

    /// Its sum over the rank's cells, weighted by volumes as in box_operators.hpp.
    BoxForce sum(const BoxOperators& box);

 private:
    ResidualSquare find_residual(BoxOperators& box, RigidGrains& grains);
    void choose_direction(const BoxOperators& box, RigidGrains& grains, bool first, double& rz,
                          const IterationLimit& limit);
    ImageProducts apply(BoxOperators& box, const RigidGrains& grains, bool keep);
    void move(RigidGrains& grains, double alpha, bool again);
    void move_only(RigidGrains& grains, double alpha);

    VelocityRows& image() { return work_.images; }
    RigidChange& rigid_residual() { return work_.change; }

    CorrectionWork& work_;
    double per_laplacian_ = 0.0;  // nu dt [m2]
    ImpulsesOfWindow window_;
    bool summed_ = true;    // the sum of f is known
    double pending_ = 0.0;  // f lacks this share of r
    VelocityRows residual_;
    BoxForce sum_residual_{};                  // over the rank's cells, before the first iteration
    VelocityRows later_;                       // d of all iterations but the first, where it is r
    const VelocityRows* direction_ = nullptr;  // null: r
    RigidChange rigid_direction_;
};

}  // namespace turbidite
