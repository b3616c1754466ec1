// SPDX-License-Identifier: GPL-3.0-or-later
//
// An fvMesh as the multiplier method wants it: a rectilinear grid with cells found by number, on
// several ranks with a halo around this rank's cells. Velocities are those of a step that keeps
// them as contiguous components; of other steps they are copied from U before step 5 and back after
// it.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "fluid_adapter/fluid_window/fluid_store.hpp"
#include "fluid_adapter/foam_app/createFields.hpp"
#include "fluid_adapter/foam_case/fluid_domain.hpp"
#include "fluid_adapter/ranks/halo_exchange.hpp"
#include "fluid_adapter/ranks/local_block.hpp"
#include "fluid_adapter/ranks/shared_grains.hpp"

namespace turbidite {

class FoamFluidField final : public StoredField {
 public:
    /// Throws Failure, on every rank, if the mesh is not the grid of the case.
    FoamFluidField(FluidFields& fields, const FluidDomain& domain);

    const CellGrid& grid() const override { return grid_; }
    const CellTable& cells() const override { return cells_; }
    int local_cells() const override { return owned_ + static_cast<int>(halo_velocity_[0].size()); }
    int owned_cells() const override { return owned_; }
    double reference_mass() const override { return cell_mass_; }
    bool shares(int cell) const override { return halo_ && (!owns(cell) || in_a_halo_[cell]); }
    double* velocity(int axis) override { return velocity_[axis]; }
    std::array<const double*, 2> import_halo(const double* x, const double* y) override;
    void share_sums(double* x, double* y) const override;
    void sum_over_ranks(double* values, int count) const override;
    void hold_grains(const GrainId* ids, int count) const override;
    void sum_over_holders(double* rows, int per_grain) const override;

    /// i + nx (k + nz j) of each of this rank's cells. Throws Failure as the constructor does.
    std::vector<int> cell_numbers() const;

    /// Works on the velocity that the step keeps, or, if it keeps none, on copies from U, as at
    /// first.
    void work_on(FluidStep& step);

    /// In space, where a rank has whole layers.
    int first_layer() const override { return first_cell_ / (grid_.counts[0] * grid_.counts[2]); }

    /// The cell of the mesh with this local index, after work_on.
    int mesh_cell(int cell) const { return mesh_cell_.empty() ? cell : mesh_cell_[cell]; }

    /// u of one of this rank's cells, wherever it is [m/s].
    Vec3 velocity_of(int cell) const;

    void accelerate(const Vec3& change) override;
    FluidMomentum momentum() const override;
    void load(const Constraint& constraint) override;
    void store(const Constraint& constraint) override;
    void put_force_density(const Constraint& constraint) override;

 private:
    void load(int cell);
    void know_halo();
    void copy_velocity();
    void find_layers();
    FluidMomentum momentum_of_layers() const;

    FluidFields& fields_;
    CellGrid grid_;
    std::optional<LocalBlock> block_;       // in the plane
    CellTable cells_;                       // local indices in a block of the grid
    std::unique_ptr<HaloExchange> halo_;    // on several ranks
    std::unique_ptr<SharedGrains> shared_;  // on several ranks
    std::vector<int> shared_cells_;         // own cells in another rank's halo
    std::vector<char> in_a_halo_;           // the same, by cell
    std::array<std::vector<double>, 2> halo_velocity_;
    std::array<std::vector<double>, 2> copies_;  // of U, unless a step keeps the velocity
    std::array<double*, 3> velocity_{};
    std::vector<int> mesh_cell_;  // in space: by local index
    int first_cell_ = 0;          // in space: number of the first
    bool copies_used_ = true;
    int owned_ = 0;
    double cell_mass_ = 0.0;
};

}  // namespace turbidite
