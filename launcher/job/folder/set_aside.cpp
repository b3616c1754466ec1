// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/job/folder/set_aside.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "coupler/checkpoint/checkpoint_sets.hpp"
#include "coupler/protocol/failure.hpp"
#include "launcher/case/files/run_folder.hpp"
#include "launcher/job/folder/run_lock.hpp"

namespace turbidite {
namespace {

namespace fs = std::filesystem;

constexpr int lines_at_the_start = 2;  // names of the columns, t = 0

fs::path first_free(const fs::path& folder) {
    fs::path free = folder;
    for (int n = 1; fs::exists(fs::symlink_status(free)); ++n)
        free = fmt::format("{}-old-{}", folder.string(), n);
    return free;
}

}  // namespace

bool has_windows(const fs::path& folder) {
    std::ifstream history(RunFolder{folder}.history());
    // Rows are whole lines: one that was cut off does not count.
    const auto lines = std::count(std::istreambuf_iterator<char>(history), {}, '\n');
    if (lines > lines_at_the_start) return true;
    const auto sets = CheckpointSets(folder).names();  // "w00000480", newest first
    // The set of t = 0, w00000000, holds no windows.
    return !sets.empty() && sets.front().find_first_not_of("w0") != std::string::npos;
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
