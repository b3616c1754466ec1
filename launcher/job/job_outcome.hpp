// SPDX-License-Identifier: LGPL-2.1-or-later
//
// How a job ended: from the coupler's record in run.json if there is one, otherwise from mpirun's
// exit status and the logs.
#pragma once

#include <string>
#include <vector>

#include "coupler/protocol/failure.hpp"
#include "launcher/case/files/run_folder.hpp"
#include "launcher/job/job.hpp"

namespace turbidite {

struct JobOutcome {
    ExitCode code = ExitCode::done;
    std::string error;  ///< empty when done
    /// Log of the program at fault; empty if that is not known.
    std::filesystem::path log = {};
    /// Its last_words(), where the folder will not be there to look at.
    std::string log_tail = {};
    /// The signal that asked to stop; the job may have been done before it could. 0: none.
    int signal = 0;
};

/// That of a job which a signal has stopped.
ExitCode signal_code(int signal);

/// The message is, in this order, that of the coupler's record, of the program that ended first
/// (first_end, with the phase in which the coupler saw it), of the coupler's log, or of mpirun.
/// Completes run.json if the coupler left no record. `ranks` names the ranks of the world, to
/// identify the one that mpirun reports as dead.
JobOutcome settle_outcome(const RunFolder& folder, const JobEnd& end,
                          const std::vector<std::string>& ranks);

/// The message for the user at the end.
std::string outcome_text(const RunFolder& folder, const JobOutcome& outcome);

/// The last lines of the log of the program at fault, or if that is not known, of mpirun's log and
/// of every program's; without those that repeat the message.
std::string last_words(const RunFolder& folder, const JobOutcome& outcome);

}  // namespace turbidite
