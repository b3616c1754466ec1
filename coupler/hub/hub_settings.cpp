// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/hub/hub_settings.hpp"

namespace turbidite {
namespace {

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
    result.users_program = result.solves.users_program;
    result.springs = settings.has("run.md_frequency");
    return result;
}

}  // namespace turbidite
