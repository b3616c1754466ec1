// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A child program in a session of its own, so that the terminal's Ctrl-C reaches us alone: the
// first SIGINT, SIGTERM or SIGHUP becomes a stop request, the second ends every process of the
// session.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace turbidite {

struct JobOrder {
    std::vector<std::string> arguments;
    std::filesystem::path error_log;               ///< takes its stderr
    std::function<void(int signal)> request_stop;  ///< called once, at the first signal
};

struct JobEnd {
    int status = 0;       ///< exit code, or 128 + signal
    int signal = 0;       ///< the first that asked to stop; 0 for none
    bool killed = false;  ///< the second came
};

/// Waits for the end. Throws Failure (exit code 4) when the program cannot be started.
JobEnd run_job(const JobOrder& order);

}  // namespace turbidite
