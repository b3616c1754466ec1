// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The share of each cell that grains cover (indicator function), for output. Valid C++17.
#pragma once

#include <array>
#include <vector>

#include "fluid_adapter/multiplier/fluid_field.hpp"
#include "fluid_adapter/multiplier/immersed_grain.hpp"

namespace turbidite {

/// By owned cell, from 0 to 1: samples in 8 x 8 places of a cell, exact to a few per cent of a cell
/// on a grain's surface. Of spheres in space the exact lengths along x at 8 x 8 places of y and z.
/// `grains`: all that touch this rank's cells, with their hydrodynamic radii.
std::vector<double> covered_share(const FluidField& field,
                                  const std::vector<ImmersedGrain>& grains);

using CellIndex = std::array<int, 3>;  ///< i, j, k; may lie beyond a cyclic side

/// Of a line along an axis through a cell of a grid in space, the share that a sphere covers.
/// `place`: where the line is in the cell on the other axes, from -0.5 to 0.5.
double covered_length(const CellGrid& grid, const Eigen::Vector3d& centre, double radius, int along,
                      const CellIndex& cell, const Vec3& place);

/// Layers between which something reaches; they may lie beyond a cyclic side, where they are those
/// of an image, and are no more than a period.
struct LayerRange {
    CellIndex first{}, last{};
};
LayerRange layers_reached_by(const CellGrid& grid, const WallBody& wall);

/// Of a cell in space that a wall covers, as if its face were flat and normal to y there.
double covered_share(const CellGrid& grid, const WallBody& wall, const CellIndex& cell);

}  // namespace turbidite
