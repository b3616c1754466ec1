// SPDX-License-Identifier: GPL-3.0-or-later
//
// Steps 1 to 3 by OpenFOAM's operators, on any mesh and with any scheme of its tables.
#pragma once

#include "fluid_adapter/foam_app/fluidStep.hpp"
#include "fluid_adapter/foam_app/stokesProjection.hpp"
#include "fluid_adapter/foam_app/viscousDiffusion.hpp"

namespace turbidite {

class OperatorStep final : public FluidStep {
 public:
    /// `divergence_goal`: largest |div phi| after the projection [1/s].
    OperatorStep(FluidFields& fields, double divergence_goal)
        : fields_(fields), projection_(fields, divergence_goal), viscosity_(fields) {}

    Projection project() override;
    std::vector<BoundaryForce> transport(int parts) override;
    BoundaryForce diffuse() override;
    bool finite() override;
    std::int64_t kind() const override { return 1; }
    std::vector<double> memory() override;
    void set_memory(const std::vector<double>& values) override;

 private:
    FluidFields& fields_;
    StokesProjection projection_;
    ViscousDiffusion viscosity_;
};

}  // namespace turbidite
