// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/domain/grain_reach.hpp"

#include <cmath>

#include "coupler/protocol/run_values.hpp"
#include "coupler/protocol/scene/mesh_rows.hpp"

namespace turbidite {
namespace {

// A cell of the rank may be in the stencil of a surface point up to 1.5 cells outside its part
// (rule 6 of multiplier/plane/collocation_points.hpp), and whether that point is kept depends on
// grains within one point spacing of it, at most 4 cells (rules 2 and 3): 5.5 cells, plus a safety
// margin.
constexpr double reach_in_cells = 7.0;

/// Edge of the largest cells within reach of a grain [m].
double largest_cell(const Settings& settings) {
    const double cell = run_values(settings).diameter / settings.real("fluid.cells_per_diameter");
    if (!rows_are_stretched(settings)) return cell;
    // Then grains may be anywhere, also in the highest rows.
    if (settings.flag("fluid.allow_coarse")) return settings.real("fluid.stretch_largest") * cell;
    // h r^3 (protocol/scene/mesh_rows.hpp): grains stay below the stretched rows.
    return std::pow(settings.real("fluid.stretch_ratio"), 3) * cell;  // the first stretched rows
}

}  // namespace

Box with_reach(Box own, const Settings& settings) {
    const double reach = reach_in_cells * largest_cell(settings);
    for (double& lower : own.lower) lower -= reach;
    for (double& upper : own.upper) upper += reach;
    return own;
}

}  // namespace turbidite
