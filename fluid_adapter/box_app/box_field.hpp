// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A fluid in space in plain arrays: the velocity is the step's own, and every rank has whole layers
// of cells. Valid C++17.
#pragma once

#include <memory>
#include <vector>

#include "fluid_adapter/fluid_window/fluid_store.hpp"
#include "fluid_adapter/linear_solvers/pencils.hpp"
#include "fluid_adapter/ranks/shared_grains.hpp"

namespace turbidite {

class BoxField final : public StoredField {
 public:
    /// `layers`: those of this rank.
    BoxField(const CellGrid& grid, double density, const RankGroup& ranks, const Span& layers);

    void work_on(FluidStep& step);

    /// p over rho_f, and what is to be taken off it where no side fixes it.
    void set_pressure(const double* p, double level);
    const std::vector<double>& pressure() const { return p_; }
    std::vector<double>& pressure() { return p_; }

    const CellGrid& grid() const override { return grid_; }
    const CellTable& cells() const override { return none_; }
    int first_layer() const override { return layers_.first; }
    int owned_cells() const override { return layers_.count * grid_.counts[0] * grid_.counts[2]; }
    int local_cells() const override { return owned_cells(); }
    double reference_mass() const override { return mass_; }
    double* velocity(int axis) override { return velocity_[axis]; }
    void sum_over_ranks(double* values, int count) const override { ranks_.sum(values, count); }
    void hold_grains(const GrainId* ids, int count) const override;
    void sum_over_holders(double* rows, int per_grain) const override;
    void import_layers(const VelocityPointers& u, LayersBeside& beside) const override;

    void load(const Constraint&) override {}
    void store(const Constraint&) override {}
    void put_force_density(const Constraint&) override {}
    bool shows_force_density() const override { return false; }
    void accelerate(const Vec3& change) override;
    FluidMomentum momentum() const override;
    double shown_pressure(int cell) const override { return p_[cell] - level_; }
    Vec3 shown_velocity(int cell) const override;

 private:
    CellGrid grid_;
    RankGroup ranks_;
    Span layers_;
    double mass_;     // rho_f V of a cell
    CellTable none_;  // of the plane
    std::unique_ptr<SharedGrains> shared_;
    std::array<double*, 3> velocity_{};
    BoxRows* rows_ = nullptr;  // of the step
    std::vector<double> p_;
    double level_ = 0.0;
};

}  // namespace turbidite
