// SPDX-License-Identifier: GPL-3.0-or-later
//
// Steps 1 to 3 by OpenFOAM's operators, on any mesh and with any scheme of its tables.
#pragma once

#include "fluid_adapter/fluid_window/fluid_step.hpp"
#include "fluid_adapter/foam_app/operators/stokesProjection.hpp"
#include "fluid_adapter/foam_app/operators/viscousDiffusion.hpp"

namespace turbidite {

class OperatorStep final : public FluidStep, private SecondOrderHost {
 public:
    /// `divergence_goal`: largest |div phi| after the projection [1/s].
    /// `central`: see SecondOrder::largest_courant.
    OperatorStep(FluidFields& fields, double divergence_goal, bool second_order,
                 std::optional<double> central)
        : fields_(fields),
          projection_(fields, divergence_goal),
          viscosity_(fields),
          in_second_order_(second_order),
          largest_courant_(SecondOrder::largest_courant(central)),
          last_flux_(0.0 * fields.phi) {}

    Projection project() override;
    TransportParts parts(double courant) const override;
    std::vector<BoundaryForce> transport(const TransportParts& parts) override;
    BoundaryForce diffuse() override;
    bool finite() override;
    void sides_changed() override { viscosity_.forget_sides(); }
    void forget_rates() override { second_order_.forget(); }
    std::int64_t kind() const override { return in_second_order_ ? 3 : 1; }
    std::vector<double> memory() override;
    void set_memory(const std::vector<double>& values) override;

 private:
    std::vector<VelocityValues> velocity_values() override;
    void velocity_changed() override { fields_.U.correctBoundaryConditions(); }
    SideForce play(const VelocityStage& stage) override;
    SideForce convect(double dt);
    SideForce advance(double dt, bool viscous);
    double fastest_decay(double dt) const;
    Foam::surfaceScalarField flux_of_the_middle() const;
    double carried_courant();
    SideForce diffuse_implicitly(double dt) override;

    FluidFields& fields_;
    StokesProjection projection_;
    ViscousDiffusion viscosity_;
    bool in_second_order_;
    double largest_courant_;          // of a sub-step in second order
    bool viscous_transport_ = false;  // step 2 has done step 3, in this window
    SecondOrder second_order_;
    Foam::surfaceScalarField last_flux_;  // phi1 of the last window, in second order
};

}  // namespace turbidite
