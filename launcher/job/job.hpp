// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A child program in its own session, so that the terminal's Ctrl-C reaches only this process: the
// first SIGINT, SIGTERM or SIGHUP becomes a stop request, the second (or the first, where the
// program cannot be asked) kills every process of the session.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace turbidite {

struct JobOrder {
    std::vector<std::string> arguments;
    std::filesystem::path error_log;        ///< receives its stderr
    std::filesystem::path output_log = {};  ///< its stdout; empty: that of this program
    /// Called once, at the first signal. False: the program cannot be asked, it is to be killed.
    std::function<bool(int signal)> request_stop;
    /// Asked every second, if there is one. True: the program should have ended, it is to be
    /// killed.
    std::function<bool()> overdue = {};
    /// For a program that has nothing to do without its children on this host, like mpirun in a job
    /// of one host: whether it has had any. It is killed when it stays for ten seconds after the
    /// last of them. They may have come and gone between two looks at the processes.
    std::function<bool()> had_children = {};
};

struct JobEnd {
    int status = 0;        ///< exit code, or 128 + signal
    int signal = 0;        ///< the first stop signal; 0: none
    bool killed = false;   ///< on request: a second signal came, or it could not be asked
    bool overdue = false;  ///< JobOrder::overdue has said so
    bool crashed = false;  ///< ended by a signal that was not sent on request
};

/// While it exists, writing to a pipe whose reader has gone is an error and no signal: Ctrl-C ends
/// `turbidite run | tee log` whose `tee` it has ended first in order, too. The job does not inherit
/// it.
class PipesMayBreak {
 public:
    PipesMayBreak();
    ~PipesMayBreak();
    PipesMayBreak(const PipesMayBreak&) = delete;
    PipesMayBreak& operator=(const PipesMayBreak&) = delete;

 private:
    void (*before_)(int);
};

/// From now on SIGUSR1, with which batch systems announce the end of their time, waits for the next
/// job: it ends neither preparations nor a report.
void hold_announcements();

/// Whether one is waiting. It is taken.
bool announced();

/// Waits for the end. Throws Failure (exit code 4) if the program cannot be started.
JobEnd run_job(const JobOrder& order);

}  // namespace turbidite
