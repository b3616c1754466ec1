// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "coupler/protocol/failure.hpp"
#include "launcher/case/files/run_folder.hpp"
#include "launcher/job/programs.hpp"

namespace turbidite {

/// Throws Failure (bad_input) naming a directory that is not a run folder.
void require_run_folder(const std::filesystem::path& directory);

/// TURBIDITE_REPORT=off leaves it to `turbidite report`.
bool report_wanted();

/// Runs launcher/report/report.py; false if it failed, with its messages on stderr. SIGINT ends the
/// script and this program, as in all that follow.
bool write_report(const RunFolder& folder, const Programs& programs);

/// Runs launcher/report/film.py; done, bad_input for a run without outputs, or participant_failed,
/// with its messages on stderr.
ExitCode write_film(const RunFolder& folder, const Programs& programs);

/// Runs launcher/report/compare.py, which writes `page` and the numbers beside it; without `each`
/// it averages runs that differ only in the seed. On failure returns bad_input if the runs cannot
/// be compared, otherwise participant_failed; its messages are on stderr.
ExitCode write_comparison(const std::filesystem::path& page, const std::vector<RunFolder>& runs,
                          bool each, const Programs& programs);

/// Runs launcher/report/study.py: the results table and figures of the runs of `folder`/study.json
/// that are there. On failure returns bad_input if a file of somebody else is in their place,
/// otherwise participant_failed; its messages are on stderr.
ExitCode write_study_results(const std::filesystem::path& folder, const Programs& programs);

}  // namespace turbidite
