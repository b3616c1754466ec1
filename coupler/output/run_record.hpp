// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The coupler's part of run.json: who took part, how far the run got, how it ended. What `turbidite
// run` has written is kept.
#pragma once

#include <filesystem>
#include <vector>

#include "coupler/output/measures/run_statistics.hpp"
#include "coupler/output/run_warnings.hpp"
#include "coupler/protocol/failure.hpp"
#include "coupler/protocol/hello.hpp"

namespace turbidite {

struct RunStatus {
    ExitCode code = ExitCode::done;
    std::string reason;  ///< the first error, empty when done
    double wall_seconds = 0.0;
    struct {
        std::int64_t written = 0;
        double seconds = 0.0;
    } checkpoints;  ///< of this part of the run
    RunStatistics statistics;
    std::vector<RunWarning> warnings;
};

/// Replaces run.json atomically, and the disk has it. `ranks` identify themselves; empty if the
/// start failed. Throws Failure when the disk is full.
void write_run_record(const std::filesystem::path& file, const RunStatus& status,
                      const std::vector<Hello>& ranks);

/// True if the record states how the run ended.
bool has_verdict(const std::filesystem::path& file);

}  // namespace turbidite
