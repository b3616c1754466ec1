// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/job/folder/set_aside.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>

#include "coupler/checkpoint/checkpoint_sets.hpp"
#include "coupler/protocol/failure.hpp"
#include "launcher/case/files/run_folder.hpp"
#include "launcher/job/folder/run_lock.hpp"

namespace turbidite {
namespace {

namespace fs = std::filesystem;

/// That of the last row of a history, in its first column; 0 without rows. Rows are whole lines:
/// one that was cut off does not count.
std::int64_t last_step(const fs::path& file) {
    std::ifstream history(file);
    std::string row;
    for (std::string line; std::getline(history, line) && !history.eof();) row = line;
    return std::strtoll(row.c_str(), nullptr, 10);  // the names of the columns give 0
}

fs::path first_free(const fs::path& folder) {
    fs::path free = folder;
    for (int n = 1; fs::exists(fs::symlink_status(free)); ++n)
        free = fmt::format("{}-old-{}", folder.string(), n);
    return free;
}

}  // namespace

std::int64_t windows_kept(const fs::path& folder) {
    return std::max(CheckpointSets(folder).newest_windows(),
                    last_step(RunFolder{folder}.history()));
}

bool has_windows(const fs::path& folder) {
    return windows_kept(folder) > 0;
}

fs::path set_aside(const fs::path& folder) {
    const auto lock = RunLock::take(folder);
    if (!lock)
        throw Failure(ExitCode::bad_input,
                      folder.string() + " " + RunLock::in_use + "; it stays where it is");
    const fs::path aside = first_free(folder);
    std::error_code error;
    fs::rename(folder, aside, error);
    if (error)
        throw Failure(ExitCode::participant_failed,
                      fmt::format("cannot rename {} to {}: {}", folder.string(), aside.string(),
                                  error.message()));
    fs::remove(aside / RunLock::file, error);  // it goes by its old name
    return aside;
}

}  // namespace turbidite
