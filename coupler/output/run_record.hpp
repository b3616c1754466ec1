// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The coupler's part of run.json: who took part, how far the run got, how it ended. What `turbidite
// run` wrote before is kept.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "coupler/hub/participant_link.hpp"
#include "coupler/hub/scheme.hpp"
#include "coupler/protocol/failure.hpp"

namespace turbidite {

/// Over the windows of a `joint` run.
struct JointMaxima {
    std::int64_t rounds = 0;
    double mismatch = 0.0;                 ///< where a window ended [u_c]
    std::int64_t unconverged_windows = 0;  ///< ended by coupling.iterations
};

/// Scaled natural map of every window's contact solve, of adapters that have one.
class ContactResiduals {
 public:
    void take_in(const ContactReport& report);
    bool empty() const { return values_.empty(); }
    /// 0 without windows, infinite when one was not a number.
    double largest() const;
    /// The smallest value that `share` of the windows do not exceed, 0 < share <= 1.
    double quantile(double share) const;

 private:
    std::vector<double> values_;
};

struct RunMaxima {
    double penetration = 0.0;              ///< [D]
    double grain_balance = 0.0;            ///< KickRule::defect
    double fluid_balance = 0.0;            ///< FluidReport::momentum_defect
    double divergence = 0.0;               ///< after step 1 [u_c/D]
    std::int64_t unconverged_windows = 0;  ///< contact solves that did not reach their tolerance
    std::optional<JointMaxima> joint;      ///< empty under other schemes

    /// `velocity` is u_c [m/s].
    void take_in(const JointReport& report, double velocity);
};

struct RunStatus {
    ExitCode code = ExitCode::done;
    std::string reason;  ///< the first error, empty when done
    std::int64_t windows_done = 0;
    double wall_seconds = 0.0;
    RunMaxima maxima;
    ContactResiduals contact_residuals;
};

/// Replaces run.json in one step. `links` may be empty when the start failed. Throws Failure when
/// the disk is full.
void write_run_record(const std::filesystem::path& file, const RunStatus& status,
                      const std::vector<ParticipantLink*>& links);

/// True when the record says how the run ended.
bool has_verdict(const std::filesystem::path& file);

}  // namespace turbidite
