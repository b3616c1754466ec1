// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/fields/spaceField.hpp"

#include <algorithm>

#include "fluid_adapter/fluid_window/layer_momentum.hpp"

namespace turbidite {

void SpaceField::work_on(FluidStep& step) {
    for (int axis = 0; axis < 3; ++axis) velocity_[axis] = step.velocity(axis);
    rows_ = step.rows();
    find_layers();
}

void SpaceField::find_layers() {
    const std::vector<int> numbers = cell_numbers();
    // Whole layers: the numbers of a rank's cells follow each other, in any order in the mesh.
    first_cell_ = *std::min_element(numbers.begin(), numbers.end());
    mesh_cell_.resize(numbers.size());
    for (std::size_t c = 0; c < numbers.size(); ++c)
        mesh_cell_[numbers[c] - first_cell_] = static_cast<int>(c);
}

void SpaceField::import_layers(const VelocityPointers& u, LayersBeside& beside) const {
    if (fields_.ranks.parallel()) import_layers_of(*rows_, u, layers(), beside);
}

void SpaceField::accelerate(const Vec3& change) {
    const int owned = owned_cells();
    for (int axis = 0; axis < 3; ++axis)
        for (int cell = 0; cell < owned; ++cell) velocity_[axis][cell] += change[axis];
}

FluidMomentum SpaceField::momentum() const {
    return momentum_of_layers(*this, velocity_, fields_.ranks);
}

}  // namespace turbidite
