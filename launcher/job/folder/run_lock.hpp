// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A run folder in use: its file `lock` is locked as long as the launcher or the job it started
// lives, whatever ends them.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>

namespace turbidite {

class RunLock {
 public:
    /// How long to wait for a job that was killed to be gone [s].
    static constexpr std::chrono::seconds for_the_killed{3};

    /// Null if another process has the folder, which must exist, and keeps it for all of
    /// `patience`. Where the file system knows no locks, the folder counts as free. Throws Failure
    /// (bad input) if the file cannot be opened, or has content: it is somebody's own, and stays.
    static std::shared_ptr<RunLock> take(const std::filesystem::path& folder,
                                         std::chrono::seconds patience = for_the_killed);

    /// Whether another process has the folder now; false if it does not exist. Throws as above.
    static bool is_held(const std::filesystem::path& folder);

    /// Environment of a job whose launcher has the lock; a job that was started by the line of
    /// `--dry-run` takes it itself.
    static constexpr const char* held_variable = "TURBIDITE_LOCK_HELD";

    /// What is told of a folder that another process has, and what to do.
    static constexpr const char* in_use = "is in use by a run that has not ended";
    static constexpr const char* how_to_get_it =
        "Wait for it, or stop it: create a file STOP in the folder.";

    /// Name of the file in a run folder.
    static constexpr const char* file = "lock";

    ~RunLock();
    RunLock(const RunLock&) = delete;
    RunLock& operator=(const RunLock&) = delete;

 private:
    RunLock(std::filesystem::path file, int descriptor)
        : file_(std::move(file)), descriptor_(descriptor) {}

    std::filesystem::path file_;
    int descriptor_;  // inherited by the job
};

}  // namespace turbidite
