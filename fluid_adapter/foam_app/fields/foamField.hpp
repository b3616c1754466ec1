// SPDX-License-Identifier: GPL-3.0-or-later
//
// An fvMesh as the multiplier method wants it: a rectilinear grid with cells found by number.
#pragma once

#include <memory>
#include <vector>

#include "fluid_adapter/domain/fluid_domain.hpp"
#include "fluid_adapter/fluid_window/fluid_store.hpp"
#include "fluid_adapter/foam_app/fields/createFields.hpp"
#include "fluid_adapter/ranks/shared_grains.hpp"

namespace turbidite {

class FoamField : public StoredField {
 public:
    const CellGrid& grid() const override { return grid_; }
    int owned_cells() const override { return fields_.mesh.nCells(); }
    double reference_mass() const override { return cell_mass_; }
    double* velocity(int axis) override { return velocity_[axis]; }
    void sum_over_ranks(double* values, int count) const override;
    void hold_grains(const GrainId* ids, int count) const override;
    void sum_over_holders(double* rows, int per_grain) const override;
    void put_force_density(const Constraint& constraint) override;
    double shown_pressure(int cell) const override { return fields_.p[mesh_cell(cell)]; }
    Vec3 shown_velocity(int cell) const override;

    /// i + nx (k + nz j) of each of this rank's cells. Throws Failure, on every rank, if the mesh
    /// is not the grid of the case.
    std::vector<int> cell_numbers() const;

    /// The velocity is what the step keeps, if it keeps any.
    virtual void work_on(FluidStep& step) = 0;

    /// The cell of the mesh with this local index, after work_on.
    virtual int mesh_cell(int cell) const = 0;

    /// u of one of this rank's cells, wherever it is [m/s].
    virtual Vec3 velocity_of(int cell) const = 0;

 protected:
    FoamField(FluidFields& fields, const FluidDomain& domain);

    /// The velocity that the multiplier method has in a cell.
    Vec3 constrained(int cell) const;

    FluidFields& fields_;
    std::array<double*, 3> velocity_{};

 private:
    CellGrid grid_;
    double cell_mass_;
    std::unique_ptr<SharedGrains> shared_;  // on several ranks
};

/// That of the case's dimension. Throws Failure as cell_numbers does.
std::unique_ptr<FoamField> make_foam_field(FluidFields& fields, const FluidDomain& domain);

}  // namespace turbidite
