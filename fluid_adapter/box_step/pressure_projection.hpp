// SPDX-License-Identifier: GPL-2.0-or-later
//
// Step 1 of a window on rows of a box (box_step.hpp): the p that makes S.u + k e solenoidal, and
// what it makes of u and e. One pass over the layers, from below. Valid C++17.
#pragma once

#include "fluid_adapter/box_step/box_fluid.hpp"
#include "fluid_adapter/linear_solvers/separable_solve.hpp"

namespace turbidite {

class PressureProjection {
 public:
    /// Keeps references to all but the grid. `u`: readers of the velocity's components.
    PressureProjection(const BoxLayers& layers, const SeparableOperator& grid, BoxRows& rows,
                       std::vector<RowReader>& u, FaceValues& excess, HeldFlux& held);

    /// u becomes u1, e that of this window; k: the part of e that is kept.
    FluxReport project(SeparableSolve& pressure, const VelocityPointers& u, double dt, double k);

    /// Holds the solenoidal flux nearest to S.u + e; u and e stay as they are.
    FluxReport hold_solenoidal_flux(SeparableSolve& pressure, const VelocityPointers& u, double dt);

 private:
    using Values = std::vector<double>;

    void begin(SeparableSolve& pressure, const VelocityPointers& u, double dt);
    void right_hand_side(int j, double dt, double* out);
    void flux(int axis, int j, double* faces);
    void projected(int axis, int j, double dt, double* faces);
    void correct_layer(int j, double dt, const VelocityPointers& u);
    void correct_across(int j, double dt);
    void correct_within(int axis, int j, double dt);
    void hold(int axis, int j, double dt, Values& faces);
    void check(int j);
    FluxReport report(double dt) const;

    const BoxLayers& layers_;
    std::vector<RowReader>& u_;
    RowReader p_;
    FaceValues& excess_;
    HeldFlux& held_;
    double kept_ = 1.0;
    Values flux_x_, flux_below_, flux_above_, flux_z_;  // of a layer
    Values corrected_below_, corrected_here_;           // v1 of two layers
    std::vector<PaddedLayer> corrected_;                // u1 and w1 of a layer
    FluxCheck check_, held_check_;                      // of phi1, of the flux that is held
};

}  // namespace turbidite
