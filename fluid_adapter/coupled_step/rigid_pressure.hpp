// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The pressure of a fluid with rigid grains: with s the velocity without it and W of
// rigid_grains.hpp,
//
//     u = W(s - dt G p),    D u + div e = 0        G, D, e: box_step/box_operators.hpp
//
// by conjugate gradients on p from an earlier one: residual r = -(D u + div e), preconditioned by
// the fluid's own pressure solve -(1/dt) laplacian^-1, which is exact without grains. The operator
// -dt (D W G + smoothing) is symmetric and not negative. Valid C++17.
#pragma once

#include "fluid_adapter/box_step/box_step.hpp"
#include "fluid_adapter/coupled_step/rigid_viscosity.hpp"

namespace turbidite {

class RigidPressure {
 public:
    explicit RigidPressure(BoxStep& step) : step_(step) {}

    /// Begins a window of length dt [s]: p is the step's.
    void begin(BoxOperators& box, double dt);

    /// x, y += f - dt G p, f the viscous impulse.
    void predict(BoxOperators& box, const RowsOfTwo& f, double* x, double* y) const {
        box.predict(dt_, p_.data(), f, x, y);
    }

    /// Takes the grains' places; k is the part of the excess that remains of the last window's.
    void place_grains(BoxOperators& box, const CollocationPoints& points, double k);

    /// Corrects the window's velocity and p until the rms of r is below the tolerance [1/s].
    IterationResult correct(BoxOperators& box, RigidGrains& grains, const IterationLimit& limit);

    /// Ends the window: p and the excess become the step's.
    void end(BoxOperators& box);

 private:
    double find_residual(BoxOperators& box, const RigidGrains& grains);
    void precondition();
    void choose_direction(BoxOperators& box, RigidGrains& grains, bool first, double& rz,
                          const IterationLimit& limit);
    ImageProducts apply(BoxOperators& box, const RigidGrains& grains, bool keep);
    void move(RigidGrains& grains, double alpha, bool again);
    ExcessFlux excess() { return {step_.excess(0).data(), step_.excess(1).data()}; }

    BoxStep& step_;
    double dt_ = 0.0;
    std::vector<double> p_, outside_, residual_, direction_, image_, preconditioned_;
    RigidChange rigid_, rigid_direction_;  // W(-dt G z), W(-dt G d)
};

}  // namespace turbidite
