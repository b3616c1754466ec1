// SPDX-License-Identifier: GPL-3.0-or-later
//
// The OpenFOAM case as the store of a window's fields: its time loop, function objects, boundary
// values, output.
#pragma once

#include <filesystem>
#include <memory>

#include "fluid_adapter/fluid_window/fluid_store.hpp"
#include "fluid_adapter/fluid_window/probes.hpp"
#include "fluid_adapter/fluid_window/slices.hpp"
#include "fluid_adapter/foam_app/fields/foamField.hpp"
#include "fluid_adapter/foam_app/fields/outputFields.hpp"
#include "fluid_adapter/foam_app/fields/sideVelocity.hpp"
#include "fluid_adapter/foam_app/functionObjects.hpp"

namespace turbidite {

class FoamStore final : public FluidStore {
 public:
    /// Opens the OpenFOAM case. Throws Failure (bad_input) naming the key that does not fit.
    FoamStore(const std::filesystem::path& directory, const RankGroup& ranks,
              const Settings& settings);

    FoamField& field() override { return *field_; }
    FluidStep& step() override { return *step_; }
    const RankGroup& ranks() const override { return fields_.ranks; }
    double density() const override { return fields_.rho; }
    double equal_height() const override;
    MovedSides begin(const Window& window) override;
    bool finished() const override { return fields_.finished(); }
    bool observed() const override { return functions_.any(); }
    void show(const std::vector<ImmersedGrain>& grains) override;
    void interpolate_flux() override { fields_.interpolate_flux(); }
    double largest_divergence() const override { return fields_.largest_divergence(); }
    std::vector<double> probes() const override { return probes_.values(*field_, fields_.ranks); }
    void write(const std::vector<ImmersedGrain>& grains) override;
    void write_slices(const std::vector<ImmersedGrain>& grains) override;
    void guard(const std::string& doing, const std::function<void()>& work) const override;
    void log(const std::string& line) const override;

    FluidFields& fields() { return fields_; }

 private:
    const FluidDomain domain_;
    FluidFields fields_;
    std::unique_ptr<FoamField> field_;
    SideVelocity sides_;
    std::unique_ptr<FluidStep> step_;
    OutputFields output_;
    FunctionObjects functions_;
    Probes probes_;
    Slices slices_;
    std::int64_t windows_ = 0;  // of the run, with the present one
};

}  // namespace turbidite
