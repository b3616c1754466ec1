// SPDX-License-Identifier: GPL-3.0-or-later
//
// Steps 1 to 3 by OpenFOAM's operators, on any mesh and with any scheme of its tables.
#pragma once

#include "fluid_adapter/box_step/second_order.hpp"
#include "fluid_adapter/foam_app/fluidStep.hpp"
#include "fluid_adapter/foam_app/stokesProjection.hpp"
#include "fluid_adapter/foam_app/viscousDiffusion.hpp"

namespace turbidite {

class OperatorStep final : public FluidStep, private SecondOrderHost {
 public:
    /// `divergence_goal`: largest |div phi| after the projection [1/s].
    OperatorStep(FluidFields& fields, double divergence_goal, bool second_order)
        : fields_(fields),
          projection_(fields, divergence_goal),
          viscosity_(fields),
          in_second_order_(second_order),
          last_flux_(0.0 * fields.phi) {}

    Projection project() override;
    std::vector<BoundaryForce> transport(int parts) override;
    BoundaryForce diffuse() override;
    bool finite() override;
    void sides_changed() override { viscosity_.forget_sides(); }
    void forget_rates() override { second_order_.forget(); }
    double largest_courant() const override;
    std::int64_t kind() const override { return in_second_order_ ? 3 : 1; }
    std::vector<double> memory() override;
    void set_memory(const std::vector<double>& values) override;

 private:
    std::vector<VelocityValues> velocity_values() override;
    void velocity_changed() override { fields_.U.correctBoundaryConditions(); }
    SideForce convect(double dt) override;
    SideForce diffuse_implicitly(double dt) override;

    FluidFields& fields_;
    StokesProjection projection_;
    ViscousDiffusion viscosity_;
    bool in_second_order_;
    SecondOrder second_order_;
    Foam::surfaceScalarField last_flux_;  // phi1 of the last window, in second order
};

}  // namespace turbidite
