// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The pressure of a fluid with rigid grains: with s the velocity without it and W of
// rigid_grains.hpp,
//
//     u = W(s - dt G p),    D u + div e = 0        G, D, e: box_step/box_operators.hpp
//
// by conjugate gradients on p from an earlier one: residual r = -(D u + div e), preconditioned by
// the fluid's own pressure solve -(1/dt) laplacian^-1, which is exact without grains. The operator
// dt (smoothing - D W G) is symmetric and not negative. p and e are the step's.
//
// A cell whose neighbours are all those of bodies of prescribed motion, or beyond a side, keeps its
// D u whatever p is. That is not zero where a body lies on an inflow, or moves off a side or
// another such body: there nothing is asked. Liquid enters a gap when a cell of it is free.
// Valid C++17.
#pragma once

#include "fluid_adapter/box_step/box_step.hpp"
#include "fluid_adapter/coupled_step/rigid_viscosity.hpp"

namespace turbidite {

class RigidPressure {
 public:
    /// From now on the step keeps its pressure.
    RigidPressure(BoxStep& step, CorrectionWork& work) : step_(step), work_(work) {
        step.keep_pressure();
    }

    /// Takes the grains' places in a window of length dt [s]; k is the part of the excess flux that
    /// remains outside grains, a the acceleration by a body force [m/s2].
    void begin(Constraint& constraint, double dt, double k, const std::array<double, 3>& a);

    /// Corrects the window's velocity and p until the rms of r is below the tolerance [1/s].
    IterationResult correct(BoxOperators& box, RigidGrains& grains, const IterationLimit& limit);

    /// Ends the window: the excess becomes that of p.
    void end(BoxOperators& box) { box.update_excess(dt_, step_.pressure(), excess()); }

 private:
    void find_enclosed(const Constraint& constraint, const std::vector<CellSide>& films);
    void leave_out_enclosed(BoxOperators& box, const RigidGrains& grains, ResidualSquare& square);
    ResidualSquare find_residual(BoxOperators& box, RigidGrains& grains);
    void precondition(const SeparableSolve::LayerWork& take);
    double precondition_with_product(const RigidGrains& grains);
    void choose_direction(BoxOperators& box, RigidGrains& grains, bool first, double& rz,
                          const IterationLimit& limit);
    ImageProducts apply(BoxOperators& box, const RigidGrains& grains, bool keep);
    void move(RigidGrains& grains, double alpha, bool again);
    std::vector<double>& residual() { return work_.images[0]; }
    std::vector<double>& later() { return work_.images[1]; }
    RigidChange& rigid() { return work_.change; }  // W(-dt G d)
    ExcessFlux excess() { return {step_.excess_pointers(), w_.data(), &film_}; }

    BoxStep& step_;
    CorrectionWork& work_;
    double dt_ = 0.0;
    WedgeFlow film_;
    std::vector<double> w_, image_;      // w of box_operators.hpp
    bool has_driven_ = false;            // some body's motion is prescribed, on any rank
    std::vector<int> enclosed_;          // cells whose div u + div e no pressure changes
    const double* direction_ = nullptr;  // z itself if there is but one iteration, or later()
};

}  // namespace turbidite
