// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/covered_share.hpp"

#include <algorithm>
#include <cmath>

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

/// Distances of a cell's nearest and farthest points from a sphere's centre.
struct Reach {
    double nearest, farthest;
};

Reach reach_of(const CellGrid& grid, const Eigen::Vector3d& centre, const CellIndex& cell) {
    // Squares of both, axis by axis: a cell is a box with edges along the axes.
    double near = 0.0, far = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double off = std::abs(grid.centre(axis, cell[axis]) - centre[axis]);
        const double half = 0.5 * grid.size(axis, cell[axis]);
        near += std::pow(std::max(0.0, off - half), 2);
        far += std::pow(off + half, 2);
    }
    return {std::sqrt(near), std::sqrt(far)};
}

/// The same of a sphere: the mean over lines along x of the part of them that is inside.
double share_of_cell_in_space(const CellGrid& grid, const ImmersedGrain& grain,
                              const CellIndex& cell) {
    const Reach reach = reach_of(grid, grain.position, cell);
    // Only cells that the surface cuts need the lines.
    if (reach.farthest <= grain.radius) return 1.0;
    if (reach.nearest >= grain.radius) return 0.0;
    double sum = 0.0;
    for (int a = 0; a < samples; ++a)
        for (int b = 0; b < samples; ++b)
            sum += covered_length(grid, grain.position, grain.radius, 0, cell,
                                  {0.0, (a + 0.5) / samples - 0.5, (b + 0.5) / samples - 0.5});
    return sum / (samples * samples);
}

double share_of(const CellGrid& grid, const ImmersedGrain& grain, const CellIndex& cell) {
    if (grain.wall) return covered_share(grid, *grain.wall, cell);
    return grid.dimension == 3 ? share_of_cell_in_space(grid, grain, cell)
                               : share_of_cell(grid, grain, cell[0], cell[1]);
}

LayerRange layers_reached_by(const CellGrid& grid, const ImmersedGrain& grain) {
    if (grain.wall) return layers_reached_by(grid, *grain.wall);
    LayerRange layers;
    for (int axis = 0; axis < grid.dimension; ++axis) {
        layers.first[axis] = grid.layer(axis, grain.position[axis] - grain.radius);
        layers.last[axis] = grid.layer(axis, grain.position[axis] + grain.radius);
    }
    return layers;
}

void cover(const FluidField& field, const ImmersedGrain& grain, std::vector<double>& shares) {
    const CellGrid& grid = field.grid();
    const auto [first, last] = layers_reached_by(grid, grain);
    // The place of a cell is that of the index before it is wrapped: the image at this grain.
    for (int j = first[1]; j <= last[1]; ++j)
        for (int k = first[2]; k <= last[2]; ++k)
            for (int i = first[0]; i <= last[0]; ++i) {
                const int cell =
                    field.cell(grid.wrapped(0, i), grid.wrapped(1, j), grid.wrapped(2, k));
                if (cell < 0 || !field.owns(cell)) continue;
                // Two grains may share a cell; where they overlap their shares could exceed it.
                shares[cell] = std::min(1.0, shares[cell] + share_of(grid, grain, {i, j, k}));
            }
}

}  // namespace

/// Half a chord of the sphere is sqrt(R^2 - d^2), d the distance of the line from its centre.
double covered_length(const CellGrid& grid, const Eigen::Vector3d& centre, double radius, int along,
                      const CellIndex& cell, const Vec3& place) {
    double square = radius * radius;
    for (int axis = 0; axis < 3; ++axis) {
        if (axis == along) continue;
        const double at = grid.centre(axis, cell[axis]) + place[axis] * grid.size(axis, cell[axis]);
        square -= (at - centre[axis]) * (at - centre[axis]);
    }
    if (square <= 0.0) return 0.0;
    const double half = std::sqrt(square), size = grid.size(along, cell[along]);
    const double off = grid.centre(along, cell[along]) - centre[along];
    const double lower = std::max(off - 0.5 * size, -half),
                 upper = std::min(off + 0.5 * size, half);
    return std::max(0.0, upper - lower) / size;
}

LayerRange layers_reached_by(const CellGrid& grid, const WallBody& wall) {
    const Extent all = extent_of(wall.surface, wall.half_thickness);
    LayerRange layers;
    for (int axis = 0; axis < 3; ++axis) {
        const LayerSpan span = grid.layers_within(axis, 0.5 * (all.low[axis] + all.high[axis]),
                                                  0.5 * (all.high[axis] - all.low[axis]));
        layers.first[axis] = span.low;
        layers.last[axis] = span.high;
    }
    return layers;
}

double covered_share(const CellGrid& grid, const WallBody& wall, const CellIndex& cell) {
    const Vec3 centre{grid.centre(0, cell[0]), grid.centre(1, cell[1]), grid.centre(2, cell[2])};
    const double inside = wall.half_thickness - distance(wall.surface, centre);
    return std::clamp(0.5 + inside / grid.size(1, cell[1]), 0.0, 1.0);
}

std::vector<double> covered_share(const FluidField& field,
                                  const std::vector<ImmersedGrain>& grains) {
    std::vector<double> shares(field.owned_cells(), 0.0);
    for (const ImmersedGrain& grain : grains) cover(field, grain, shares);
    return shares;
}

}  // namespace turbidite
