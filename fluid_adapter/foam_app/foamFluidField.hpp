// SPDX-License-Identifier: GPL-3.0-or-later
//
// An fvMesh as FluidField for the multiplier method: a uniform grid with cells found by number, on
// several ranks with a halo around this rank's cells. Velocities are copied to contiguous
// components before step 5 and back after it.
#pragma once

#include <memory>
#include <vector>

#include "fluid_adapter/foam_app/createFields.hpp"
#include "fluid_adapter/foam_case/fluid_domain.hpp"
#include "fluid_adapter/multiplier/collocation_points.hpp"
#include "fluid_adapter/ranks/halo_exchange.hpp"
#include "fluid_adapter/ranks/local_block.hpp"
#include "fluid_adapter/ranks/shared_grains.hpp"

namespace turbidite {

class FoamFluidField final : public FluidField {
 public:
    /// Throws Failure, on every rank, if the mesh is not the uniform grid of the case.
    FoamFluidField(FluidFields& fields, const FluidDomain& domain);

    const CellGrid& grid() const override { return grid_; }
    const CellTable& cells() const override { return cells_; }
    int local_cells() const override { return static_cast<int>(x_.size()); }
    bool owns(int cell) const override { return cell < owned_; }
    double reference_mass() const override { return cell_mass_; }
    bool shares(int cell) const override { return halo_ && (!owns(cell) || in_a_halo_[cell]); }
    double* velocity(int axis) override { return axis == 0 ? x_.data() : y_.data(); }
    void import_halo(double* x, double* y) const override;
    void share_sums(double* x, double* y) const override;
    void sum_over_ranks(double* values, int count) const override;
    void hold_grains(const GrainId* ids, int count) const override;
    void sum_over_holders(double* rows, int per_grain) const override;

    /// i + nx j of each of this rank's cells. Throws Failure as the constructor does.
    std::vector<int> cell_numbers() const;

    /// Copies velocities from U for the cells of these points and those that other ranks know; no
    /// others are read.
    void load(const CollocationPoints& points);

    /// Copies velocities to U for the cells of these points. With `force_density`, also sets lambda
    /// = -rho_f (u - u3)/dt.
    void store(const CollocationPoints& points, bool force_density);

 private:
    void load(int cell);
    void store(int cell, bool force_density);

    FluidFields& fields_;
    CellGrid grid_;
    LocalBlock block_;
    CellTable cells_;                       // local indices in a block of the grid
    std::unique_ptr<HaloExchange> halo_;    // on several ranks
    std::unique_ptr<SharedGrains> shared_;  // on several ranks
    std::vector<int> shared_cells_;         // own cells in another rank's halo
    std::vector<char> in_a_halo_;           // the same, as a flag per cell
    std::vector<double> x_, y_;
    int owned_ = 0;
    double cell_mass_ = 0.0;
};

}  // namespace turbidite
