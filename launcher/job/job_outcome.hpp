// SPDX-License-Identifier: LGPL-2.1-or-later
//
// How a job ended: from the coupler's record in run.json if there is one, otherwise from mpirun's
// exit status and the logs.
#pragma once

#include <string>
#include <vector>

#include "coupler/protocol/failure.hpp"
#include "launcher/case/run_folder.hpp"
#include "launcher/job/job.hpp"

namespace turbidite {

struct JobOutcome {
    ExitCode code = ExitCode::done;
    std::string error;  ///< empty when done
};

/// Completes run.json if the coupler left no record. `ranks` names the ranks of the world, to
/// identify the one that mpirun reports as dead.
JobOutcome settle_outcome(const RunFolder& folder, const JobEnd& end,
                          const std::vector<std::string>& ranks);

/// The message for the user at the end.
std::string outcome_text(const RunFolder& folder, const JobOutcome& outcome);

/// The last lines of mpirun's log and of every program's.
std::string log_tails(const RunFolder& folder);

}  // namespace turbidite
