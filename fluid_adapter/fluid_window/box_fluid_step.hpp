// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Steps 1 to 3 on rows of a box (box_step/box_step.hpp) as a FluidStep. A rank works on complete
// rows. Where these are also what step 5 works on, the velocity stays in them, and the fields u and
// p are copied when somebody asks; otherwise u is copied to rows before the steps and back after
// them. Valid C++17.
#pragma once

#include <memory>
#include <optional>

#include "fluid_adapter/fluid_window/fluid_step.hpp"
#include "fluid_adapter/ranks/rank_group.hpp"

namespace turbidite {

/// The fields u and p of a store, by complete rows of this rank; by all ranks.
class RowFields {
 public:
    virtual ~RowFields() = default;

    /// Step 5 works on the rows themselves: in the plane they are the store's cells in the same
    /// order, in space all that the rank has.
    virtual bool stay_in_rows() const = 0;

    virtual int first_row() const = 0;  ///< in the box, of this rank

    virtual void read_velocity(const VelocityPointers& u) = 0;   ///< [m/s]
    virtual void write_velocity(const VelocityPointers& u) = 0;  ///< from u [m/s]
    virtual void read_pressure(double* p) = 0;                   ///< over rho_f [m2/s2]

    /// `floating`: no side fixes p, and it is zero in the first cell of the box.
    virtual void write_pressure(const double* p, bool floating) = 0;

    /// What u holds on the sides, by component, along whole sides of the box.
    virtual VelocityOnSides side_velocity() const = 0;
};

class BoxFluidStep final : public FluidStep, private SecondOrderHost {
 public:
    /// Begins with the velocity of the fields. `coupled`: pressure and viscosity are corrected
    /// together with the grains; velocities must stay in rows.
    BoxFluidStep(const BoxFluid& fluid, std::unique_ptr<BoxRows> rows,
                 std::unique_ptr<RowFields> fields, const RankGroup& ranks, bool coupled);

    void begin(double dt) override { dt_ = dt; }
    Projection project() override;
    TransportParts parts(double courant) const override;
    std::vector<BoundaryForce> transport(const TransportParts& parts) override;
    BoundaryForce diffuse() override;
    CoupledStep* coupled() override { return coupled_ ? &*coupled_ : nullptr; }
    std::vector<BoundaryForce> end_coupled() override;
    bool finite() override;
    double* velocity(int axis) override;
    BoxRows* rows() override { return &step_.rows(); }
    void put_velocity() override;
    void put_unconstrained() override;
    void take_velocity() override;
    void sides_changed() override;
    void put_pressure() override;
    void forget_rates() override { second_order_.forget(); }
    void forget_pressure() override;
    std::int64_t kind() const override {
        return in_second_order_ ? (coupled_ ? 7 : 4) : coupled_ ? 6 : 2;
    }
    std::vector<double> memory() override;
    void set_memory(const std::vector<double>& values) override;

    /// The arrays of `memory` themselves. Whoever fills them calls take_pressure before.
    void visit_memory(const ValuesVisit& visit);
    void take_pressure() { fields_->read_pressure(step_.pressure()); }
    MemoryRows memory_rows() const override;

 private:
    void lend(bool lent);
    FluxReport solenoidal();
    void load();
    void store();
    BoxStep::Force on_all_ranks(BoxStep::Force force) const;
    VelocityPointers components();
    std::vector<MemoryRows::Array> flux_rows() const;

    std::vector<VelocityValues> velocity_values() override;
    void velocity_changed() override {}
    SideForce play(const VelocityStage& stage) override { return step_.play(stage); }
    SideForce convect(double dt, ImpulsesOfWindow* impulses);
    std::vector<BoundaryForce> transport_in_first_order(int parts);
    std::vector<BoundaryForce> transport_in_second_order(const TransportParts& parts);
    SideForce diffuse_implicitly(double dt) override;

    std::unique_ptr<RowFields> fields_;
    RankGroup ranks_;
    BoxStep step_;
    double dt_ = 0.0;  // of the present window [s]
    bool in_second_order_;
    double largest_courant_;          // of a sub-step in second order
    bool viscous_transport_ = false;  // step 2 has done step 3, in this window
    SecondOrder second_order_;
    std::optional<CoupledStep> coupled_;
    bool lent_ = false;  // arrays of transport, to pressure and viscosity
    bool floating_;      // no side fixes p
};

}  // namespace turbidite
