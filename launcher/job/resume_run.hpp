// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A run folder made ready to go on from its last whole checkpoint. What was written after it is
// removed: rows and series by the coupler, which knows their lengths, folders of later times of the
// fluid here. Logs of earlier parts are kept in logs/part-1, logs/part-2, …
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "launcher/job/play_run.hpp"

namespace turbidite {

struct Resumed {
    PreparedRun run;
    std::int64_t windows = 0;      ///< done before
    double time = 0.0;             ///< [t_c]
    std::string case_before = {};  ///< text of case.yaml before overrides; empty without
    nlohmann::ordered_json record_before = {};             ///< run.json
    std::filesystem::file_time_type history_written = {};  ///< when, by the part before
};

/// Makes the folder ready; empty if its run is complete. `say` gets a line for a damaged checkpoint
/// that is passed over. Throws Failure (bad input) for a folder that is no run, is in use, has no
/// whole checkpoint among those it has, or for overrides of keys that a run may not change.
/// Settings that only this version knows, or only that of the checkpoint, are no change.
///
/// A folder in which no checkpoint was written yet is prepared again and starts from the beginning,
/// unless it has windows that are done.
std::optional<Resumed> prepare_resumption(const std::filesystem::path& folder,
                                          const std::vector<std::string>& overrides,
                                          const LaunchSite& site,
                                          const std::function<void(const std::string&)>& say);

/// After a job that failed before its first window, or of whose windows nothing is left: the folder
/// has the values again that it had before the overrides, which what has refused them would refuse
/// each time. False if it keeps them.
bool take_back_overrides(const Resumed& resumed, ExitCode code);

/// Keys that may differ from those of the checkpoint; a trailing dot stands for a group.
const std::vector<std::string>& keys_that_may_change();

}  // namespace turbidite
