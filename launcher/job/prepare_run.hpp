// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Creates a run folder from a resolved case: case.yaml, grains/initial.csv, run.json, the fluid
// case with its mesh, an empty logs/.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "launcher/case/case_file.hpp"
#include "launcher/case/run_folder.hpp"

namespace turbidite {

struct RunOrder {
    std::filesystem::path out;  ///< empty: runs/<case name>-<yyyymmdd-hhmmss>
    bool force = false;         ///< empty an existing run folder
};

/// Creates the folder and returns its absolute path. A non-empty folder is refused (exit code 2)
/// unless `force`.
RunFolder make_run_folder(const RunOrder& order, const std::string& case_name);

/// Fills it. `command` is the launch line, kept in run.json.
void prepare_run(const ResolvedCase& resolved, const RunFolder& folder,
                 const std::vector<std::string>& command);

/// Throws Failure (exit code 2) naming a program of the job that is not built or not installed.
void require_programs(const Settings& settings, const std::vector<std::filesystem::path>& needed);

}  // namespace turbidite
