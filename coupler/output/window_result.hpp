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
    /// What the worst grain fails.
    enum class Rule {
        wet,   ///< M dU = (M - m_f) g dt + J_c + F_h dt
        dry,   ///< M dU = M g dt + J_c
        state  ///< U of the state = U of the kick, J_c of the state = J_c of the motion
    };

    double defect = 0.0;
    GrainId worst = 0;  ///< the grain with the largest residual
    Rule rule = Rule::wet;
    double largest = 0.0;  ///< of all terms [kg m/s]
};

/// How far a grain ended from where the velocity it moves with takes it, turns on its
/// circumference (hub/checks/motion_rule).
struct MotionDefect {
    double defect = 0.0;  ///< [m]
    GrainId worst = 0;
};

struct WindowResult {
    Motion motion;  ///< after step 4
    Kicks kicks;    ///< after step 5; empty in dry runs
    Motion state;   ///< at t^{n+1}
    std::optional<JointReport> joint = {};
    std::optional<GrainBalance> grain_balance = {};
    std::optional<MotionDefect> motion_defect = {};
};

}  // namespace turbidite
