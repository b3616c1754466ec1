// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The result of a window, for output.
#pragma once

#include <optional>

#include "coupler/protocol/records.hpp"

namespace turbidite {

/// Convergence between contacts and fluid, for schemes that solve contacts in rounds.
struct JointReport {
    std::int64_t rounds = 0;  ///< contact solves
    double mismatch = 0.0;    ///< largest FreeResponse::mismatch after the last one [m/s]
    bool converged = true;    ///< mismatch within coupling.tolerance
};

struct WindowResult {
    Motion motion;  ///< after step 4
    Kicks kicks;    ///< after step 5; empty in dry runs
    Motion state;   ///< at t^{n+1}
    std::optional<JointReport> joint = {};
    std::optional<double> grain_balance = {};  ///< KickRule::defect; empty in dry runs
};

}  // namespace turbidite
