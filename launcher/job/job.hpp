// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A child program in its own session, so that the terminal's Ctrl-C reaches only this process: the
// first SIGINT, SIGTERM or SIGHUP becomes a stop request, the second kills every process of the
// session.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace turbidite {

struct JobOrder {
    std::vector<std::string> arguments;
    std::filesystem::path error_log;               ///< receives its stderr
    std::function<void(int signal)> request_stop;  ///< called once, at the first signal
};

struct JobEnd {
    int status = 0;       ///< exit code, or 128 + signal
    int signal = 0;       ///< the first stop signal; 0: none
    bool killed = false;  ///< a second signal came
};

/// Waits for the end. Throws Failure (exit code 4) if the program cannot be started.
JobEnd run_job(const JobOrder& order);

}  // namespace turbidite
