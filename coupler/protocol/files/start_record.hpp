// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// How far every program of a job has come in its start, and whether it ends: RUN/logs/starts/
/// ROLE.RANK, one file per rank. turbidite-member writes who it is and the library a line for each
/// step, so that a program that never joins or never leaves can be named: those that wait for it in
/// MPI_Init, in the split of the world or in MPI_Finalize cannot ask. Valid C++17.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "coupler/protocol/hello.hpp"
#include "coupler/protocol/settings.hpp"

namespace turbidite {

/// The steps of a start, in this order, and MPI_Finalize; a program that has taken a step may still
/// wait in it for the others.
enum class StartStep { none, mpi_init, split, announcement, end };

/// What is known of one rank of a program that has been started.
struct StartRecord {
    Role role = Role::grains;
    int rank = 0;
    std::string host;
    long pid = 0;
    std::string program;
    std::string log;
    StartStep step = StartStep::none;  ///< the last one before the end
    bool left = false;                 ///< it has come to MPI_Finalize
};

/// turbidite-member: writes the record of the program that this process becomes, without a step,
/// and returns its file, for `member_variable`.
std::string begin_start_record(const std::filesystem::path& run, const StartRecord& record);

/// The program: notes that it is about to take a step. Does nothing without turbidite-member.
void note_start(StartStep step);

/// The log that turbidite-member has opened for this program; empty without turbidite-member.
std::string started_log();

/// Empty if turbidite-member has not written one.
std::optional<StartRecord> read_start_record(const std::filesystem::path& run, Role role, int rank);

/// The records of all ranks of these participants that have not taken the step.
std::vector<StartRecord> not_yet_at(StartStep step, const std::filesystem::path& run,
                                    const std::vector<Role>& roles, const Settings& settings);

/// Those of them that have come to MPI_Finalize instead: they will never take it.
std::vector<StartRecord> left_before(StartStep step, const std::filesystem::path& run,
                                     const std::vector<Role>& roles, const Settings& settings);

/// The hosts of all programs that have been started, one for each; empty before the first.
std::vector<std::string> hosts_of_started(const std::filesystem::path& run);

/// "nothing from grains rank 0 (program, host, pid, log) within limits.start = 120 s: it has not
/// called MPI_Init".
std::string late_start_text(StartStep step, const std::vector<StartRecord>& late, double limit);

/// "grains rank 0 (program, host, pid, log) has left MPI (MPI_Finalize) without joining the run".
std::string left_text(const std::vector<StartRecord>& left);

/// "the run is over, but grains rank 0 (program, host, pid, log) has not ended within
/// limits.stall_hard = 600 s and is killed"; mpirun if all of its programs have ended.
std::string late_end_text(const std::vector<StartRecord>& late, double limit);

}  // namespace turbidite
