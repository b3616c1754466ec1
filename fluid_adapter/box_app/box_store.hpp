// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A case's fluid in space as the store of windows, without OpenFOAM. Valid C++17.
#pragma once

#include <filesystem>
#include <memory>

#include "coupler/protocol/run_values.hpp"
#include "fluid_adapter/box_app/box_field.hpp"
#include "fluid_adapter/box_app/field_series.hpp"
#include "fluid_adapter/domain/fluid_domain.hpp"
#include "fluid_adapter/domain/side_motion.hpp"
#include "fluid_adapter/fluid_window/box_fluid_step.hpp"
#include "fluid_adapter/fluid_window/probes.hpp"
#include "fluid_adapter/fluid_window/slices.hpp"
#include "fluid_adapter/ranks/cell_rows.hpp"

namespace turbidite {

/// The pressure of the field, and the velocity on sides: the rest is the step's own.
class LayerFields final : public RowFields {
 public:
    LayerFields(BoxField& field, const CellRows& rows,
                const std::array<SideMotion, box_sides.size()>& motions);

    bool stay_in_rows() const override { return true; }
    int first_row() const override { return field_.first_layer(); }
    void read_velocity(const VelocityPointers&) override {}
    void write_velocity(const VelocityPointers&) override {}
    void read_pressure(double* p) override;
    void write_pressure(const double* p, bool floating) override;
    VelocityOnSides side_velocity() const override { return held_; }

    /// Sets the sides for the window [time, time + step].
    MovedSides set_sides(double time, double step);

    const VelocityOnSides& held() const { return held_; }

 private:
    BoxField& field_;
    CellRows rows_;
    std::array<SideMotion, box_sides.size()> motions_;
    VelocityOnSides held_;
};

class BoxStore final : public FluidStore {
 public:
    /// `folder`: for files. Throws Failure (bad_input) naming the key that does not fit.
    BoxStore(const Settings& settings, const RankGroup& ranks, const std::filesystem::path& folder);

    BoxField& field() override { return field_; }
    const BoxField& field() const { return field_; }
    BoxFluidStep& step() override { return *step_; }
    const RankGroup& ranks() const override { return ranks_; }
    double density() const override { return run_.fluid_density; }
    double equal_height() const override;
    MovedSides begin(const Window& window) override;
    bool finished() const override { return windows_ >= run_.windows; }
    bool observed() const override { return false; }
    void show(const std::vector<ImmersedGrain>&) override {}
    void interpolate_flux() override {}
    double largest_divergence() const override;
    std::vector<double> probes() const override { return probes_.values(field_, ranks_); }
    void write(const std::vector<ImmersedGrain>& grains) override;
    void write_slices(const std::vector<ImmersedGrain>& grains) override;
    void guard(const std::string&, const std::function<void()>& work) const override { work(); }
    void log(const std::string& line) const override;

    Box box() const;  ///< of this rank's layers

 private:
    std::unique_ptr<BoxRows> box_rows() const;

    const FluidDomain domain_;
    const RunValues run_;
    RankGroup ranks_;
    CellGrid grid_;
    CellRows rows_;
    mutable BoxField field_;
    std::unique_ptr<BoxRows> neighbours_;  // of this rank's layers, for what is written
    LayerFields* fields_ = nullptr;        // the step's
    std::unique_ptr<BoxFluidStep> step_;
    Probes probes_;
    Slices slices_;
    FieldSeries series_;
    bool solid_, vorticity_;    // are written, too
    std::int64_t windows_ = 0;  // of the run, with the present one
};

}  // namespace turbidite
