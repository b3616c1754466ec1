// SPDX-License-Identifier: GPL-3.0-or-later
//
// Steps 1 to 3 on rows of a box (box_step/box_step.hpp) for OpenFOAM's fields. A rank works on
// complete rows. Where OpenFOAM's decomposition gave it such (ranks/cell_rows.hpp), the velocity
// stays in them, and U and p are copied when somebody asks; otherwise U is copied to rows before
// the steps and back after them.
#pragma once

#include "fluid_adapter/foam_app/fluidStep.hpp"
#include "fluid_adapter/foam_solver/boxCells.hpp"
#include "fluid_adapter/multiplier/cell_grid.hpp"
#include "fluid_adapter/ranks/cell_rows.hpp"

namespace turbidite {

class BoxFluidStep final : public FluidStep, private SecondOrderHost {
 public:
    /// Throws DoesNotFit.
    BoxFluidStep(FluidFields& fields, const TransportMethod& method, const BoxCells& box,
                 const CellGrid& grid);

    Projection project() override;
    TransportParts parts(double courant) const override;
    std::vector<BoundaryForce> transport(const TransportParts& parts) override;
    BoundaryForce diffuse() override;
    CoupledStep* coupled() override { return coupled_ ? &*coupled_ : nullptr; }
    std::vector<BoundaryForce> end_coupled() override;
    bool finite() override;
    double* velocity(int axis) override;
    void put_velocity() override;
    void put_unconstrained() override;
    void take_velocity() override;
    void sides_changed() override;
    void put_pressure() override;
    void forget_rates() override { second_order_.forget(); }
    std::int64_t kind() const override {
        return in_second_order_ ? (coupled_ ? 7 : 4) : coupled_ ? 6 : 2;
    }
    std::vector<double> memory() override;
    void set_memory(const std::vector<double>& values) override;
    MemoryRows memory_rows() const override;

 private:
    BoxFluidStep(FluidFields& fields, const BoxFluid& fluid, const BoxCells& box, bool coupled);

    FluxReport project(double dt);
    void load();
    void store();
    void store(const double* x, const double* y);
    BoxStep::Force on_all_ranks(BoxStep::Force force) const;

    std::vector<VelocityValues> velocity_values() override;
    void velocity_changed() override {}
    SideForce play(const VelocityStage& stage) override { return step_.play(stage); }
    SideForce convect(double dt, ImpulsesOfWindow* impulses);
    std::vector<BoundaryForce> transport_in_first_order(int parts);
    std::vector<BoundaryForce> transport_in_second_order(const TransportParts& parts);
    SideForce diffuse_implicitly(double dt) override;

    FluidFields& fields_;
    BoxCells box_;
    CellRows rows_;
    BoxStep step_;
    bool in_second_order_;
    double largest_courant_;          // of a sub-step in second order
    bool viscous_transport_ = false;  // step 2 has done step 3, in this window
    SecondOrder second_order_;
    std::optional<CoupledStep> coupled_;
    bool floating_;  // no side fixes p
    int first_row_;  // in the box, of this rank's complete rows
};

}  // namespace turbidite
