// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/covered_share.hpp"

#include <algorithm>

namespace turbidite {
namespace {

constexpr int samples = 8;  // along each edge of a cell

/// Of the cell between two layers' faces, which may lie beyond a cyclic side.
double share_of_cell(const CellGrid& grid, const ImmersedGrain& grain, int i, int j) {
    int inside = 0;
    for (int a = 0; a < samples; ++a)
        for (int b = 0; b < samples; ++b) {
            const double x = grid.centre(0, i) + ((a + 0.5) / samples - 0.5) * grid.size(0, i);
            const double y = grid.centre(1, j) + ((b + 0.5) / samples - 0.5) * grid.size(1, j);
            const Eigen::Vector3d arm(x - grain.position.x(), y - grain.position.y(), 0.0);
            inside += grain.shape->contains(grain.orientation.transpose() * arm, grain.radius);
        }
    return static_cast<double>(inside) / (samples * samples);
}

void cover(const FluidField& field, const ImmersedGrain& grain, std::vector<double>& shares) {
    const CellGrid& grid = field.grid();
    int first[2], last[2];
    for (int axis = 0; axis < 2; ++axis) {
        first[axis] = grid.layer(axis, grain.position[axis] - grain.radius);
        last[axis] = grid.layer(axis, grain.position[axis] + grain.radius);
    }
    for (int j = first[1]; j <= last[1]; ++j)
        for (int i = first[0]; i <= last[0]; ++i) {
            const int cell = field.cell(grid.wrapped(0, i), grid.wrapped(1, j), 0);
            if (cell < 0 || !field.owns(cell)) continue;
            shares[cell] = std::min(1.0, shares[cell] + share_of_cell(grid, grain, i, j));
        }
}

}  // namespace

std::vector<double> covered_share(const FluidField& field,
                                  const std::vector<ImmersedGrain>& grains) {
    std::vector<double> shares(field.owned_cells(), 0.0);
    for (const ImmersedGrain& grain : grains) cover(field, grain, shares);
    return shares;
}

}  // namespace turbidite
