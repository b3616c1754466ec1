// SPDX-License-Identifier: GPL-3.0-or-later
//
// Steps 1 to 3 on a uniform box (box_step/box_step.hpp) for OpenFOAM's fields. U is copied to rows
// of contiguous components before the steps and back after them; p is copied on request. A rank
// works on complete rows, its own if OpenFOAM's decomposition gave it complete ones
// (ranks/cell_rows.hpp). A row is all cells with the same y.
#pragma once

#include "fluid_adapter/foam_app/fluidStep.hpp"
#include "fluid_adapter/foam_solver/boxCells.hpp"
#include "fluid_adapter/ranks/cell_rows.hpp"

namespace turbidite {

class BoxFluidStep final : public FluidStep {
 public:
    /// `limiter`: k of limitedLinearV. Throws DoesNotFit.
    BoxFluidStep(FluidFields& fields, double limiter, const BoxCells& box);

    Projection project() override;
    std::vector<BoundaryForce> transport(int parts) override;
    BoundaryForce diffuse() override;
    bool finite() const override;
    void put_fields() override;
    std::int64_t kind() const override { return 2; }
    std::vector<double> memory() override;
    void set_memory(const std::vector<double>& values) override;

 private:
    BoxFluidStep(FluidFields& fields, const BoxFluid& fluid, const BoxCells& box);

    void load();
    void store();
    BoxStep::Force on_all_ranks(BoxStep::Force force) const;

    FluidFields& fields_;
    CellRows rows_;
    BoxStep step_;
    bool floating_;  // no side fixes p
};

}  // namespace turbidite
