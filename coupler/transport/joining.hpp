// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The start of a job as its first program sees it, the coupler or what plays its part: MPI, the
// split of the world, the participants' announcements. None of these waits can be polled, so all of
// it happens under a watch, which names the program that does not join.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "coupler/protocol/files/start_record.hpp"
#include "coupler/protocol/settings.hpp"
#include "coupler/transport/world.hpp"

namespace turbidite {

class Joining {
 public:
    /// `roles` are the participants of the job. After limits.start without all of them, or once one
    /// of them has left MPI instead, `failed` is called with the code (5 or 4) and a message, from
    /// another thread, and the process ends with that code.
    Joining(std::filesystem::path run, const Settings& settings, std::vector<Role> roles,
            std::function<void(ExitCode, const std::string&)> failed);

    /// Initialises MPI and splits the world. Returns this program's own communicator.
    MPI_Comm join_world(std::optional<MpiEnvironment>& mpi);

    /// The next participant that announces itself.
    JoinedParticipant meet(MPI_Comm local);

 private:
    std::vector<StartRecord> who_has_left() const;
    std::string who_is_late() const;

    std::filesystem::path run_;
    Settings settings_;
    std::vector<Role> roles_;
    std::atomic<StartStep> awaited_{StartStep::mpi_init};
    StartWatch watch_;
};

}  // namespace turbidite
