// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// Files of a run folder that several programs of the job write. Valid C++17.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "coupler/protocol/failure.hpp"
#include "coupler/protocol/hello.hpp"

namespace turbidite {

/// "coupler", "fluid rank 0".
std::string rank_name(Role role, int rank);

/// RUN/logs/grains.log, or grains.rank1.log if there are several ranks.
std::filesystem::path log_file(const std::filesystem::path& run, Role role, int rank, int ranks);

/// The program that ended first and before the run was over, in RUN/logs/first_end: since mpirun
/// ends the others at once, it is the cause.
struct FirstEnd {
    ExitCode code = ExitCode::participant_failed;  ///< of the job
    std::string who;                               ///< rank_name
    std::string what;                              ///< "ended with status 0"
};

/// Does nothing if another program was first. Returns whether this one was.
bool write_first_end(const std::filesystem::path& run, const FirstEnd& end);
/// Empty if nobody has written one. Mended (received.hpp), since any program may have written it.
std::optional<FirstEnd> read_first_end(const std::filesystem::path& run);

/// RUN/logs/waits: the coupler's last wait-for table (KeptLines), for the launcher, which tells
/// what the program that ended first was about to do.
std::filesystem::path wait_table_file(const std::filesystem::path& run);

/// A file in the run folder by which a user asks the run to stop in order.
inline constexpr const char* stop_file = "STOP";
/// The same, to write its output now.
inline constexpr const char* write_file = "WRITE";
/// The same, to write a checkpoint now.
inline constexpr const char* checkpoint_file = "CHECKPOINT";

/// Set for a program started by turbidite-member, which has opened its log, to the file in which
/// the program notes the steps of its start (start_record.hpp).
inline constexpr const char* member_variable = "TURBIDITE_MEMBER";

}  // namespace turbidite
