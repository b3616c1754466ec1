// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The settings that the hub uses, read once when it is created.
#pragma once

#include "coupler/output/measures/solve_limits.hpp"
#include "coupler/protocol/run_values.hpp"

namespace turbidite {

/// Relative defects of the momentum of grains and fluid (columns of the history).
struct BalanceLimits {
    double soft = 0.0;  ///< above it a warning
    double hard = 0.0;  ///< above it the run ends
};

struct HubSettings {
    RunValues run;
    SolveLimits solves;
    double stall_soft = 0.0;   ///< limits.stall_soft: a silent participant is named [s]
    double stall_hard = 0.0;   ///< limits.stall_hard: it ends the run [s]
    double penetration = 0.0;  ///< limits.penetration [D]
    BalanceLimits grain_balance, fluid_balance;
    bool users_program = false;  ///< moves the grains, about which no key is known
    bool springs = false;        ///< between grains, made by contact.md_* keys
};

/// Throws std::out_of_range or std::invalid_argument naming a key that is missing or of another
/// type.
HubSettings hub_settings(const Settings& settings);

}  // namespace turbidite
