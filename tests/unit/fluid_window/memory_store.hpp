// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A closed box of fluid in plain arrays, as the store of a window: without OpenFOAM.
#pragma once

#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "fluid_adapter/fluid_window/box_fluid_step.hpp"
#include "fluid_adapter/fluid_window/fluid_store.hpp"
#include "tests/unit/multiplier/memory_field.hpp"

namespace turbidite {

/// The fields of the store are the rows of the step.
class RowsInMemory final : public RowFields {
 public:
    bool stay_in_rows() const override { return true; }
    int first_row() const override { return 0; }
    void read_velocity(const VelocityPointers&) override {}
    void write_velocity(const VelocityPointers& u) override { seen_x = u[0][0]; }
    void read_pressure(double*) override {}
    void write_pressure(const double*, bool) override {}
    VelocityOnSides side_velocity() const override { return sides; }

    double seen_x = 0.0;  ///< u_x of the first cell, when it was last asked for
    VelocityOnSides sides;
};

/// The velocity is the step's own.
class StepField final : public StoredField {
 public:
    StepField(int cells, double edge, Side side) : place_(cells, cells, side, edge) {}

    void work_on(FluidStep& step) { velocity_ = {step.velocity(0), step.velocity(1)}; }

    const CellGrid& grid() const override { return place_.grid(); }
    const CellTable& cells() const override { return place_.cells(); }
    int owned_cells() const override { return place_.owned_cells(); }
    int local_cells() const override { return place_.local_cells(); }
    double reference_mass() const override { return place_.reference_mass(); }
    double* velocity(int axis) override { return velocity_[axis]; }

    void load(const Constraint&) override {}
    void store(const Constraint&) override {}
    void put_force_density(const Constraint&) override {}
    void accelerate(const Vec3& change) override {
        for (int axis = 0; axis < 2; ++axis)
            for (int c = 0; c < owned_cells(); ++c) velocity_[axis][c] += change[axis];
    }
    FluidMomentum momentum() const override {
        FluidMomentum of;
        for (int axis = 0; axis < 2; ++axis)
            for (int c = 0; c < owned_cells(); ++c) {
                of.sum[axis] += reference_mass() * velocity_[axis][c];
                of.magnitudes += reference_mass() * std::abs(velocity_[axis][c]);
            }
        return of;
    }

 private:
    MemoryField place_;
    std::array<double*, 2> velocity_{};
};

class MemoryStore final : public FluidStore {
 public:
    /// A square of n x n cells of edge h between walls, or cyclic, rho_f = 1, at rest.
    MemoryStore(int n, double h, double viscosity, bool coupled, Side side = Side::wall)
        : field_(n, h, side) {
        const auto plane = [&](End end) {
            const AxisOperator axis{n, h, end, end};
            return SeparableOperator{axis, axis};
        };
        BoxFluid fluid;
        const bool cyclic = side == Side::cyclic;
        fluid.velocity = plane(cyclic ? End::periodic : End::dirichlet);
        fluid.pressure = plane(cyclic ? End::periodic : End::neumann);
        fluid.viscosity = viscosity;
        fluid.second_order = true;
        fluid.central = 0.75;
        auto rows = std::make_unique<RowsInMemory>();
        for (SideValues& of : rows->sides) of.fill(std::vector<double>(n, 0.0));
        rows_ = rows.get();
        step_ = std::make_unique<BoxFluidStep>(fluid, std::make_unique<AllRows>(fluid.pressure),
                                               std::move(rows), ranks_, coupled);
        field_.work_on(*step_);
    }

    StepField& field() override { return field_; }
    FluidStep& step() override { return *step_; }
    const RankGroup& ranks() const override { return ranks_; }
    double density() const override { return 1.0; }
    double equal_height() const override { return resolved_height; }
    bool begin(const Window&) override {
        ++windows;
        return false;
    }
    bool finished() const override { return windows == last; }
    bool observed() const override { return looks; }
    void end() override { ended = true; }
    void interpolate_flux() override { ++fluxes; }
    double largest_divergence() const override { return 0.0; }
    std::vector<double> probes() const override { return {}; }
    void write(const std::vector<ImmersedGrain>& grains) override { written = grains.size(); }
    void guard(const std::string&, const std::function<void()>& work) const override { work(); }
    void log(const std::string& line) const override { lines.push_back(line); }

    RowsInMemory& rows() { return *rows_; }

    double resolved_height = std::numeric_limits<double>::infinity();
    bool looks = false, ended = false;
    int windows = 0, last = -1, fluxes = 0;
    std::size_t written = 0;
    mutable std::vector<std::string> lines;

 private:
    RankGroup ranks_;
    StepField field_;
    RowsInMemory* rows_ = nullptr;
    std::unique_ptr<FluidStep> step_;
};

}  // namespace turbidite
