// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "coupler/protocol/failure.hpp"
#include "launcher/case/run_folder.hpp"
#include "launcher/job/programs.hpp"

namespace turbidite {

/// Failure (bad_input) that names a directory which is no run folder.
void require_run_folder(const std::filesystem::path& directory);

/// Runs launcher/report/report.py; false when it failed, its words on stderr.
bool write_report(const RunFolder& folder, const Programs& programs);

/// Runs launcher/report/compare.py, which writes `page` and the numbers beside it; without `each`
/// it averages runs that differ in the seed alone. Not done: bad_input when the runs cannot be
/// compared, otherwise participant_failed; its words on stderr.
ExitCode write_comparison(const std::filesystem::path& page, const std::vector<RunFolder>& runs,
                          bool each, const Programs& programs);

}  // namespace turbidite
