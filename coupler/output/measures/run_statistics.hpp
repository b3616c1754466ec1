// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Statistics over the windows of a run: largest values, windows whose solves did not converge, wall
// times.
#pragma once

#include <utility>
#include <vector>

#include "coupler/output/measures/grain_work.hpp"
#include "coupler/output/window_result.hpp"
#include "coupler/protocol/run_values.hpp"

namespace turbidite {

/// Seconds of a window, or means per window.
struct WallTimes {
    double step = 0.0;      ///< the whole window
    double fluid = 0.0;     ///< in the fluid adapter's own work
    double grains = 0.0;    ///< in the grains adapter's own work
    double coupling = 0.0;  ///< in the coupler: routing, checks, output
};

/// Sums over the windows since the last row. Checkpoints contain them, and the maxima below
/// (output_state.cpp).
struct SinceRow {
    std::int64_t windows = 0;
    std::int64_t unconverged = 0;  ///< whose contact solve did not reach its tolerance
    WallTimes wall;
    GrainWork work;

    void take_in(const WallTimes& spent, bool converged, const GrainWork& done = {});
};

/// Scaled natural map of every window's contact solve, for adapters that have one.
class ContactResiduals {
 public:
    void take_in(const ContactReport& report);
    bool empty() const { return values_.empty(); }
    /// 0 without windows, infinite if one was NaN.
    double largest() const;
    /// The smallest value that `share` of the windows do not exceed, 0 < share <= 1.
    double quantile(double share) const;

    /// Of all windows, in their order.
    const std::vector<double>& values() const { return values_; }
    void replace(std::vector<double> values) { values_ = std::move(values); }

 private:
    std::vector<double> values_;
};

/// Over the windows of a run with a fluid.
struct FluidMaxima {
    double divergence = 0.0;        ///< after step 1 [u_c/D]
    double final_divergence = 0.0;  ///< after step 5, of outputs in turn [u_c/D]
    double courant = 0.0;
    double balance = 0.0;                  ///< FluidReport::momentum_defect
    double slip = 0.0;                     ///< rms over the points at the end of a solve [u_c]
    std::int64_t unconverged_windows = 0;  ///< stopped at fluid.multiplier_iterations
    double remaining_divergence = 0.0;  ///< rms after the last correction with rigid grains [u_c/D]
    std::int64_t unconverged_splitting_windows = 0;  ///< stopped at fluid.splitting_iterations
};

/// Over the windows of a run whose scheme solves contacts in rounds.
struct JointMaxima {
    std::int64_t rounds = 0;
    double mismatch = 0.0;                 ///< at the end of a window [u_c]
    std::int64_t unconverged_windows = 0;  ///< stopped at coupling.iterations
};

struct RunMaxima {
    double penetration = 0.0;    ///< [D]
    double grain_balance = 0.0;  ///< GrainBalance::defect
    double motion_defect = 0.0;  ///< MotionDefect::defect [D]
    /// ContactReport::contact_violation; empty for codes that do not tell it [u_c].
    std::optional<double> contact_violation;
    std::int64_t unconverged_windows = 0;  ///< contact solves that did not reach their tolerance
    std::optional<FluidMaxima> fluid;      ///< empty in dry runs
    std::optional<JointMaxima> joint;      ///< empty under other schemes
};

class RunStatistics {
 public:
    RunStatistics() = default;

    explicit RunStatistics(const RunValues& run);

    void take_in(const WindowResult& result);

    /// The maxima alone: also of a window that a check refused, which is not done.
    void raise_maxima(const WindowResult& result);

    /// Goes on from those of an earlier part of the run.
    void resume(const RunStatistics& earlier);

    std::int64_t windows_done = 0;
    RunMaxima maxima;
    ContactResiduals contact_residuals;

 private:
    void take_in(const FluidReport& report);
    void take_in(const JointReport& report);

    double diameter_ = 1.0, velocity_ = 1.0;  ///< D [m], u_c [m/s]
    std::int64_t output_every_ = 1;           ///< windows
};

}  // namespace turbidite
