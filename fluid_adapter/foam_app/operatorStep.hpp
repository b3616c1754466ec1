// SPDX-License-Identifier: GPL-3.0-or-later
//
// Steps 1 to 3 by OpenFOAM's operators, on any mesh, with any scheme of its tables.
#pragma once

#include "fluid_adapter/foam_app/fluidStep.hpp"
#include "fluid_adapter/foam_app/stokesProjection.hpp"
#include "fluid_adapter/foam_app/viscousDiffusion.hpp"

namespace turbidite {

class OperatorStep final : public FluidStep {
 public:
    OperatorStep(FluidFields& fields, StokesProjection projection,
                 std::unique_ptr<ViscousSolver> viscosity);

    FluxReport project(MomentumLedger& ledger) override;
    void transport(MomentumLedger& ledger, int parts) override;
    void diffuse(MomentumLedger& ledger) override;
    bool finite() const override;
    std::int64_t kind() const override { return 1; }
    std::vector<double> memory() override;
    void set_memory(const std::vector<double>& values) override;

 private:
    FluidFields& fields_;
    StokesProjection projection_;
    std::unique_ptr<ViscousSolver> viscosity_;
};

}  // namespace turbidite
