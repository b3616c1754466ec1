// SPDX-License-Identifier: GPL-2.0-or-later
//
// Step 2 of a window on rows of a box (box_step.hpp), and in stages of second order step 3: what
// faces carry of the momentum of all components. One pass over the layers, from below: the faces
// above layer j, then those of its rows. Valid C++17.
#pragma once

#include "fluid_adapter/box_step/box_fluid.hpp"
#include "fluid_adapter/box_step/transport/convective_flux.hpp"
#include "fluid_adapter/box_step/transport/velocity_stage.hpp"

namespace turbidite {

class MomentumTransport {
 public:
    /// Keeps references to all. `u`: readers of the velocity's components.
    MomentumTransport(const BoxFluid& fluid, const BoxLayers& layers, std::vector<RowReader>& u,
                      const FaceValues& excess, const HeldFlux& held);

    // Layers in ascending order; the readers have begun.

    /// Begins with the faces below the first layer.
    void begin(bool viscous);

    /// u1 of layer j becomes u2.
    void advance(int j, double dt, const VelocityPointers& u);

    /// A stage of layer j.
    void play(int j, const VelocityStage& stage);

 private:
    /// Momentum carried through faces, an array per component.
    using Carried = std::vector<std::vector<double>>;

    Carried room(std::size_t size) const {
        return Carried(layers_.components(), std::vector<double>(size));
    }
    void carry(int axis, int j, int k, Carried& carried, std::size_t first);
    void carry_below(int j);
    void carry_row(int j, int k);
    void diffuse(int axis, int j, int k, Carried& carried, std::size_t first);

    const BoxFluid& fluid_;
    const BoxLayers& layers_;
    std::vector<RowReader>& u_;
    const FaceValues& excess_;
    const HeldFlux& held_;
    bool viscous_ = false;
    std::vector<double> flux_, result_;  // of a row
    Carried along_;                      // through the faces of a row along x
    Carried below_, above_;              // of a layer
    Carried behind_, before_;            // of a row; empty in the plane
};

}  // namespace turbidite
