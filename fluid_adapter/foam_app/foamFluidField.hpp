// SPDX-License-Identifier: GPL-3.0-or-later
//
// An fvMesh as the multiplier method wants it: a uniform grid with cells found by number.
// Velocities are copied to contiguous components before step 5 and back after it.
#pragma once

#include <vector>

#include "fluid_adapter/foam_app/createFields.hpp"
#include "fluid_adapter/foam_case/fluid_domain.hpp"
#include "fluid_adapter/multiplier/collocation_points.hpp"

namespace turbidite {

class FoamFluidField final : public FluidField {
 public:
    /// Throws Failure when the mesh is not the uniform grid of the case.
    FoamFluidField(FluidFields& fields, const FluidDomain& domain);

    const CellGrid& grid() const override { return grid_; }
    int cell(int i, int j, int k) const override;
    int local_cells() const override { return static_cast<int>(x_.size()); }
    bool owns(int cell) const override { return cell < owned_; }
    double cell_mass() const override { return cell_mass_; }
    double* velocity(int axis) override { return axis == 0 ? x_.data() : y_.data(); }

    void load();  ///< from U

    /// To U, cells of these points only. With `force_density`, also lambda = -rho_f (u - u3)/dt.
    void store(const CollocationPoints& points, bool force_density);

 private:
    void map_cells();
    void store(int cell, bool force_density);

    FluidFields& fields_;
    CellGrid grid_;
    std::vector<int> local_;  // by number i + nx j
    std::vector<double> x_, y_;
    int owned_ = 0;
    double cell_mass_ = 0.0;
};

}  // namespace turbidite
