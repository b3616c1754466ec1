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

/// Largest residual of the grains' equations of motion over the largest of their terms.
struct GrainBalance {
    double defect = 0.0;
    GrainId worst = 0;  ///< the grain with the largest residual
};

struct WindowResult {
    Motion motion;  ///< after step 4
    Kicks kicks;    ///< after step 5; empty in dry runs
    Motion state;   ///< at t^{n+1}
    std::optional<JointReport> joint = {};
    std::optional<GrainBalance> grain_balance = {};  ///< KickRule::balance; empty in dry runs
};

}  // namespace turbidite
