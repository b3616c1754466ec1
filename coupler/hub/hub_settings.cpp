// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/hub/hub_settings.hpp"

#include <cmath>

#include "coupler/protocol/hello.hpp"
#include "coupler/protocol/scene/mesh_rows.hpp"

namespace turbidite {
namespace {

/// Edge of the largest cells within reach of a grain [m].
double largest_cell(const Settings& settings, const RunValues& run) {
    const double cell = run.diameter / settings.real("fluid.cells_per_diameter");
    if (!rows_are_stretched(settings)) return cell;
    // Then grains may be anywhere, also in the highest rows.
    if (settings.flag("fluid.allow_coarse")) return settings.real("fluid.stretch_largest") * cell;
    // h r^3 (protocol/scene/mesh_rows.hpp): grains stay below the stretched rows.
    return std::pow(settings.real("fluid.stretch_ratio"), 3) * cell;  // the first stretched rows
}

BalanceLimits balance_limits(const Settings& settings, const std::string& key) {
    return {settings.real(key + "_soft"), settings.real(key + "_hard")};
}

}  // namespace

HubSettings hub_settings(const Settings& settings) {
    HubSettings result;
    result.run = run_values(settings);
    result.solves = solve_limits(settings);
    result.stall_soft = settings.real("limits.stall_soft");
    result.stall_hard = settings.real("limits.stall_hard");
    result.penetration = settings.real("limits.penetration");
    result.grain_balance = balance_limits(settings, "limits.grain_balance");
    result.fluid_balance = balance_limits(settings, "limits.fluid_balance");
    if (result.run.wet) result.cell = largest_cell(settings, result.run);
    result.users_program = settings.text("grains.adapter") == users_program;
    result.springs = settings.has("run.md_frequency");
    return result;
}

}  // namespace turbidite
