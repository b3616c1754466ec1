// SPDX-License-Identifier: GPL-3.0-or-later
//
// The field in the plane: local indices are those of the mesh, and on several ranks there is a halo
// around this rank's cells, from which points on surfaces interpolate. Velocities are those of a
// step that keeps them as contiguous components; of other steps they are copied from U before step
// 5 and back after it.
#pragma once

#include <optional>

#include "fluid_adapter/foam_app/fields/foamField.hpp"
#include "fluid_adapter/ranks/halo_exchange.hpp"
#include "fluid_adapter/ranks/local_block.hpp"

namespace turbidite {

class PlaneField final : public FoamField {
 public:
    PlaneField(FluidFields& fields, const FluidDomain& domain);

    const CellTable& cells() const override { return cells_; }
    int local_cells() const override {
        return owned_cells() + static_cast<int>(halo_velocity_[0].size());
    }
    bool shares(int cell) const override { return halo_ && (!owns(cell) || in_a_halo_[cell]); }
    std::array<const double*, 2> import_halo(const double* x, const double* y) override;
    void share_sums(double* x, double* y) const override;

    void work_on(FluidStep& step) override;
    int mesh_cell(int cell) const override { return cell; }
    Vec3 velocity_of(int cell) const override;

    void accelerate(const Vec3& change) override;
    FluidMomentum momentum() const override;
    void load(const Constraint& constraint) override;
    void store(const Constraint& constraint) override;

 private:
    void load(int cell);
    void know_halo();
    void copy_velocity();

    LocalBlock block_;
    CellTable cells_;                     // local indices in a block of the grid
    std::unique_ptr<HaloExchange> halo_;  // on several ranks
    std::vector<int> shared_cells_;       // own cells in another rank's halo
    std::vector<char> in_a_halo_;         // the same, by cell
    std::array<std::vector<double>, 2> halo_velocity_;
    std::array<std::vector<double>, 2> copies_;  // of U, unless a step keeps the velocity
    bool copies_used_ = true;
};

}  // namespace turbidite
