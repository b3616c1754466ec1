// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/job/folder/claim.hpp"

#include <fmt/format.h>

#include <cstdlib>

#include "coupler/checkpoint/checkpoint_sets.hpp"
#include "coupler/protocol/failure.hpp"
#include "launcher/job/folder/set_aside.hpp"
#include "launcher/job/launch_line.hpp"

namespace turbidite {
namespace {

Failure refused(const RunFolder& folder, const std::string& fault, const std::string& remedy) {
    return Failure(ExitCode::bad_input, fmt::format("{} {}\n  {}\nNothing was started.",
                                                    folder.root.string(), fault, remedy));
}

std::string how_to_go_on(const RunFolder& folder) {
    return fmt::format(
        "`turbidite resume {0}` goes on with it, and so does the line that `turbidite resume {0} "
        "--dry-run` prints.",
        shell_line({folder.root.string()}));
}

void require_beginning(const RunFolder& folder) {
    if (has_windows(folder.root))
        throw refused(folder, "has windows that are done, and this line would begin it again",
                      how_to_go_on(folder));
}

void require_newest(const RunFolder& folder, const std::string& set) {
    const std::vector<std::string> sets = CheckpointSets(folder.root).names();
    if (sets.empty())
        throw refused(folder, fmt::format("has no checkpoint {} any more", set),
                      how_to_go_on(folder));
    if (sets.front() != set)
        throw refused(folder,
                      fmt::format("has got as far as checkpoint {}, and this line would go back to "
                                  "{}",
                                  sets.front(), set),
                      how_to_go_on(folder));
}

}  // namespace

std::shared_ptr<RunLock> claim(const RunFolder& folder, const std::string& set) {
    std::shared_ptr<RunLock> lock;
    if (std::getenv(RunLock::held_variable) == nullptr) {
        lock = RunLock::take(folder.root);
        if (!lock) throw refused(folder, RunLock::in_use, RunLock::how_to_get_it);
    }
    set.empty() ? require_beginning(folder) : require_newest(folder, set);
    return lock;
}

}  // namespace turbidite
