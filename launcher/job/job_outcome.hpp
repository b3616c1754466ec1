// SPDX-License-Identifier: LGPL-2.1-or-later
//
// How a job ended: the coupler's word in run.json if there is one, else what mpirun's exit status
// and the logs tell.
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

/// Completes run.json when the coupler left no word. `ranks` names the ranks of the world, for the
/// one that mpirun says died.
JobOutcome settle_outcome(const RunFolder& folder, const JobEnd& end,
                          const std::vector<std::string>& ranks);

/// What the user reads at the end.
std::string outcome_text(const RunFolder& folder, const JobOutcome& outcome);

/// The last lines of mpirun's log and of every program's.
std::string log_tails(const RunFolder& folder);

}  // namespace turbidite
