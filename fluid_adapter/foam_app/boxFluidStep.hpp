// SPDX-License-Identifier: GPL-3.0-or-later
//
// Steps 1 to 3 on a uniform box (box_step/box_step.hpp) for OpenFOAM's fields: U is copied to
// contiguous components before them and back after them; p and excess when somebody asks.
#pragma once

#include "fluid_adapter/foam_app/fluidStep.hpp"
#include "fluid_adapter/foam_app/uniformBox.hpp"

namespace turbidite {

class BoxFluidStep final : public FluidStep {
 public:
    /// limiter: k of limitedLinearV. Throws NotSeparable.
    BoxFluidStep(FluidFields& fields, double limiter);

    FluxReport project(MomentumLedger& ledger) override;
    void transport(MomentumLedger& ledger) override;
    void diffuse(MomentumLedger& ledger) override;
    bool finite() const override;
    void put_fields() override;
    void take_fields() override;

 private:
    void load();
    void store_row(int j);
    template <class Visit>
    void for_faces(Visit visit);

    FluidFields& fields_;
    UniformBox box_;
    BoxStep step_;
    bool floating_;  // no side fixes p
};

}  // namespace turbidite
