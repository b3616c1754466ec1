// SPDX-License-Identifier: LGPL-2.1-or-later
//
// study.json: what a study consists of and how far it is. Written before every run and after it, so
// that an interrupted study can be read and continued.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "launcher/study/study_plan.hpp"

namespace turbidite {

enum class RunState { missing, begun, done, kept, failed };

/// By the run folder alone. Where its case is the planned one: `done` when run.json says so, and
/// that all windows are; `begun` when it was killed or stopped on request and has a checkpoint to
/// go on from; `failed` when it ended otherwise. `kept`: done, and the planned one but for the
/// defaults of the version that played it (other_defaults.hpp).
RunState state_of(const PlannedRun& run, const std::filesystem::path& out);

/// Whether a run has a checkpoint from which it may go on: it has begun, or a program of it has
/// failed or stalled, which need not happen again.
bool may_go_on(const PlannedRun& run, const std::filesystem::path& out);

/// Why runs could not be played, by PlannedRun::path().
using WhyNot = std::map<std::string, std::string>;

/// Throws Failure (bad input) where `out` has a study.json that is of no study.
void require_own_record(const std::filesystem::path& out);

/// Runs that are still missing keep the reason that study.json has had. Throws Failure (exit code
/// 4) when it cannot be written.
void write_study_record(const Study& study, const std::vector<PlannedRun>& plan,
                        const std::filesystem::path& out, const WhyNot& why_not = {});

}  // namespace turbidite
