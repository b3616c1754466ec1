// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The fluid's box and its grid, from the resolved case: counts = size / D x cells per diameter,
// rounded, so that cells are as nearly square as the box allows; rows may be stretched above the
// grains (coupler/protocol/scene/mesh_rows.hpp). Valid C++17.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "coupler/protocol/scene/sides.hpp"
#include "coupler/protocol/settings.hpp"

namespace turbidite {

struct FluidDomain {
    int dimension = 2;
    std::array<double, 3> size{};  ///< in the plane z is that of the single layer of cells [m]
    std::array<int, 3> cells{1, 1, 1};
    std::vector<double> row_edges;  ///< ascending, if rows have different heights [m]; else empty
    double equal_height = 0.0;      ///< up to which rows are equal [m]
    SideTypes sides{};
};

/// Whether rows have different heights.
inline bool stretched(const FluidDomain& domain) {
    return !domain.row_edges.empty();
}

/// First layer of cells of every rank, from the bottom up, and the number of layers behind the
/// last: run.fluid_layers, without them as even as they can be. Throws Failure (bad_input) unless
/// they are all layers.
std::vector<int> first_layers(const Settings& settings, int layers, int ranks);

/// Throws Failure (bad_input) that names the key, and as side_types.
FluidDomain fluid_domain(const Settings& settings);

}  // namespace turbidite
