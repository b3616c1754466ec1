// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A box of fluid in plain arrays, in the plane or in space, as the store of a window: without
// OpenFOAM, on one rank. Valid C++17.
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fluid_adapter/fluid_window/box_fluid_step.hpp"
#include "fluid_adapter/fluid_window/fluid_store.hpp"

namespace turbidite {

struct ArrayBox {
    CellGrid grid;                         ///< equal cells
    double density = 1.0;                  ///< rho_f [kg/m3]
    double viscosity = 0.0;                ///< nu [m2/s]
    bool second_order = true;              ///< in time
    std::optional<double> central = 0.75;  ///< as BoxFluid::central; none: limitedLinearV
    bool rigid_grains = false;             ///< pressure and viscosity know the grains (CoupledStep)
};

/// A grid of equal cubes, from the origin; of squares where it has no third number of cells.
CellGrid grid_of_cubes(const std::array<int, 3>& cells, double edge,
                       const std::array<Side, 3>& sides);

/// The step's arrays are all there is; every side is at rest.
class ArrayRows : public RowFields {
 public:
    explicit ArrayRows(const CellGrid& grid);

    bool stay_in_rows() const override { return true; }
    int first_row() const override { return 0; }
    void read_velocity(const VelocityPointers&) override {}
    void write_velocity(const VelocityPointers&) override {}
    void read_pressure(double*) override {}
    void write_pressure(const double*, bool) override {}
    VelocityOnSides side_velocity() const override { return sides_; }

 private:
    VelocityOnSides sides_;
};

/// The velocity is the step's own.
class ArrayField final : public StoredField {
 public:
    explicit ArrayField(const ArrayBox& box);

    void work_on(FluidStep& step);

    const CellGrid& grid() const override { return grid_; }
    const CellTable& cells() const override { return table_; }
    int owned_cells() const override { return cells_; }
    int local_cells() const override { return cells_; }
    double reference_mass() const override { return mass_; }
    double* velocity(int axis) override { return velocity_[axis]; }

    void load(const Constraint&) override {}
    void store(const Constraint&) override {}
    void put_force_density(const Constraint&) override {}
    void accelerate(const Vec3& change) override;
    FluidMomentum momentum() const override;
    double shown_pressure(int) const override { return 0.0; }
    Vec3 shown_velocity(int cell) const override;

 private:
    CellGrid grid_;
    int cells_;
    double mass_;  // rho_f V of a cell
    std::vector<int> index_;
    CellTable table_;
    std::array<double*, 3> velocity_{};
};

class ArrayStore : public FluidStore {
 public:
    explicit ArrayStore(const ArrayBox& box);
    ArrayStore(const ArrayBox& box, std::unique_ptr<RowFields> rows);

    ArrayField& field() override { return field_; }
    FluidStep& step() override { return *step_; }
    const RankGroup& ranks() const override { return ranks_; }
    double density() const override { return density_; }
    double equal_height() const override { return std::numeric_limits<double>::infinity(); }
    MovedSides begin(const Window&) override { return {}; }
    bool finished() const override { return false; }
    bool observed() const override { return false; }
    void show(const std::vector<ImmersedGrain>&) override {}
    void interpolate_flux() override {}
    double largest_divergence() const override { return 0.0; }
    std::vector<double> probes() const override { return {}; }
    void write(const std::vector<ImmersedGrain>&) override {}
    void guard(const std::string&, const std::function<void()>& work) const override { work(); }
    void log(const std::string&) const override {}

 private:
    RankGroup ranks_;
    double density_;
    ArrayField field_;
    std::unique_ptr<FluidStep> step_;
};

}  // namespace turbidite
