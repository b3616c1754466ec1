// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/spaceField.hpp"

#include <algorithm>
#include <cmath>

namespace turbidite {

void SpaceField::work_on(FluidStep& step) {
    for (int axis = 0; axis < 3; ++axis) velocity_[axis] = step.velocity(axis);
    find_layers();
}

void SpaceField::find_layers() {
    const std::vector<int> numbers = cell_numbers();
    first_cell_ = *std::min_element(numbers.begin(), numbers.end());
    mesh_cell_.resize(numbers.size());
    for (std::size_t c = 0; c < numbers.size(); ++c)
        mesh_cell_[numbers[c] - first_cell_] = static_cast<int>(c);
}

void SpaceField::accelerate(const Vec3& change) {
    const int owned = owned_cells();
    for (int axis = 0; axis < 3; ++axis)
        for (int cell = 0; cell < owned; ++cell) velocity_[axis][cell] += change[axis];
}

FluidMomentum SpaceField::momentum() const {
    std::array<double, 4> sums{};
    const LayerCells layers = this->layers();
    const std::size_t layer = layers.cells() / layers.count;
    for (int j = 0; j < layers.count; ++j) {
        const double mass = cell_mass(0, layers.first + j);
        for (int axis = 0; axis < 3; ++axis) {
            const double* u = velocity_[axis] + j * layer;
            double sum = 0.0, sizes = 0.0;
            for (std::size_t c = 0; c < layer; ++c) sum += u[c], sizes += std::abs(u[c]);
            sums[axis] += mass * sum, sums[3] += mass * sizes;
        }
    }
    fields_.ranks.sum(sums.data(), static_cast<int>(sums.size()));
    return {{sums[0], sums[1], sums[2]}, sums[3]};
}

}  // namespace turbidite
