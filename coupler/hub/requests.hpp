// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the user asks of a run that goes on, by creating files in its folder:
//
//     STOP        one more window, written, with a checkpoint; then the run ends. The file's text
//                 may be the exit code, 130 (the default) or 143
//     WRITE       the next window is written as if output were due
//     CHECKPOINT  a checkpoint after the next window
//
// They are looked for once per window, and removed when they are obeyed. A STOP file with a text
// should get its name when it is whole, by a rename. A batch system's SIGUSR1
// stops a run like the first file.
#pragma once

#include <csignal>
#include <filesystem>
#include <optional>

#include "coupler/protocol/failure.hpp"

namespace turbidite {

struct Requests {
    std::optional<ExitCode> stop;  ///< the exit code to end with
    bool write = false;
    bool checkpoint = false;
};

class RequestFiles {
 public:
    explicit RequestFiles(std::filesystem::path run_folder) : folder_(std::move(run_folder)) {}

    /// From now on a signal that is not 0 stops the run, with exit code 143.
    void stop_on(const volatile std::sig_atomic_t& signal) { signal_ = &signal; }

    /// What is asked for, once.
    Requests take() const;

 private:
    bool taken(const char* name) const;
    std::optional<ExitCode> stop() const;

    std::filesystem::path folder_;
    const volatile std::sig_atomic_t* signal_ = nullptr;
};

}  // namespace turbidite
