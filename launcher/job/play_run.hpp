// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A resolved case from its run folder to its report: prepare, start the job, wait, tell.
#pragma once

#include "launcher/job/job_outcome.hpp"
#include "launcher/job/launch_line.hpp"
#include "launcher/job/prepare_run.hpp"

namespace turbidite {

struct PreparedRun {
    RunFolder folder;
    std::shared_ptr<RunLock> lock;   ///< on the folder
    std::vector<std::string> line;   ///< mpirun and its arguments
    std::vector<std::string> ranks;  ///< who they are, by number
    Settings settings;
};

/// Makes and fills the run folder. Throws Failure (exit code 2) when a program is not there or the
/// folder is in the way.
PreparedRun prepare(const ResolvedCase& resolved, const RunOrder& order, const LaunchSite& site);

/// Fills a folder that is ours with everything that the job needs, and with what shows the run.
PreparedRun fill(const ResolvedCase& resolved, const OwnFolder& own, const LaunchSite& site);

/// Starts the job and waits; progress, outcome and report as the user of `turbidite run` meets
/// them. The first SIGINT or SIGTERM asks the job to stop after its next window, the second kills
/// it.
JobOutcome play(const PreparedRun& prepared, const Programs& programs);

}  // namespace turbidite
