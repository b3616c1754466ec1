// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/fluid_window/layer_momentum.hpp"

#include <algorithm>
#include <cmath>

namespace turbidite {

FluidMomentum momentum_of_layers(const FluidField& field, const std::array<double*, 3>& u_of,
                                 const RankGroup& ranks) {
    std::array<double, 4> sums{};
    const LayerCells layers = field.layers();
    const std::size_t layer = layers.cells() / layers.count;
    for (int j = 0; j < layers.count; ++j) {
        // Columns are equal, so that a layer has one mass per cell.
        const double mass = field.cell_mass(0, layers.first + j);
        for (int axis = 0; axis < 3; ++axis) {
            const double* u = u_of[axis] + j * layer;
            double sum = 0.0, sizes = 0.0;
            for (std::size_t c = 0; c < layer; ++c) sum += u[c], sizes += std::abs(u[c]);
            sums[axis] += mass * sum, sums[3] += mass * sizes;
        }
    }
    ranks.sum(sums.data(), static_cast<int>(sums.size()));
    return {{sums[0], sums[1], sums[2]}, sums[3]};
}

void import_layers_of(BoxRows& rows, const VelocityPointers& u, const LayerCells& cells,
                      LayersBeside& beside) {
    constexpr std::size_t deep = BoxRows::beyond;
    const std::size_t layer = cells.cells() / cells.count, block = deep * layer;
    // As BoxRows::exchange has them: two layers at either end, from below
    std::vector<double> edges(2 * block), outside(2 * block);
    for (int axis = 0; axis < 3; ++axis) {
        std::copy_n(u[axis], block, edges.begin());
        std::copy_n(u[axis] + cells.cells() - block, block, edges.begin() + block);
        rows.exchange(edges.data(), outside.data());
        beside.below[axis].assign(outside.begin() + block - layer, outside.begin() + block);
        beside.above[axis].assign(outside.begin() + block, outside.begin() + block + layer);
    }
}

}  // namespace turbidite
