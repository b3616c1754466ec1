// SPDX-License-Identifier: GPL-3.0-or-later
//
// The field in space: a rank has whole layers of cells, local indices are those of layers and not
// of the mesh, and the velocity is that of the step.
#pragma once

#include "fluid_adapter/foam_app/fields/foamField.hpp"

namespace turbidite {

class SpaceField final : public FoamField {
 public:
    SpaceField(FluidFields& fields, const FluidDomain& domain) : FoamField(fields, domain) {}

    const CellTable& cells() const override { return none_; }
    int local_cells() const override { return owned_cells(); }
    int first_layer() const override { return first_cell_ / (grid().counts[0] * grid().counts[2]); }

    void work_on(FluidStep& step) override;
    int mesh_cell(int cell) const override { return mesh_cell_[cell]; }
    Vec3 velocity_of(int cell) const override { return constrained(cell); }

    void import_layers(const VelocityPointers& u, LayersBeside& beside) const override;
    void accelerate(const Vec3& change) override;
    FluidMomentum momentum() const override;
    void load(const Constraint&) override {}
    void store(const Constraint&) override {}

 private:
    void find_layers();

    CellTable none_;              // of the plane
    BoxRows* rows_ = nullptr;     // of the step
    std::vector<int> mesh_cell_;  // by local index
    int first_cell_ = 0;          // number of the first
};

}  // namespace turbidite
