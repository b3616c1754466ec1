// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Whether a run that is there is the planned one but for the version of the program: a later
// version has more keys, fewer, or other defaults, and the resolved case of every run changes with
// it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "launcher/study/study_plan.hpp"

namespace turbidite {

/// Keys in which the resolved case of the folder differs from the planned one, as texts "key: then,
/// now by default". Nothing if it is another case: a key that study, case or command line name, or
/// named when it was played, has another value, or grains, walls or script differ; nothing, too,
/// where no case can be read.
std::optional<std::vector<std::string>> other_defaults(const PlannedRun& run,
                                                       const std::filesystem::path& folder);

}  // namespace turbidite
