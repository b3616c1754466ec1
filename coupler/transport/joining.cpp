// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/transport/joining.hpp"

#include <limits>
#include <utility>

namespace turbidite {

Joining::Joining(std::filesystem::path run, const Settings& settings, std::vector<Role> roles,
                 std::function<void(ExitCode, const std::string&)> failed)
    : run_(std::move(run)),
      settings_(settings),
      roles_(std::move(roles)),
      watch_(
          settings.real("limits.start"), [this] { return !who_has_left().empty(); },
          [this, failed = std::move(failed)] {
              const std::vector<StartRecord> left = who_has_left();
              const ExitCode code = left.empty() ? ExitCode::stalled : ExitCode::participant_failed;
              failed(code, left.empty() ? who_is_late() : left_text(left));
              return code;
          }) {}

MPI_Comm Joining::join_world(std::optional<MpiEnvironment>& mpi) {
    // Returns only when all programs of the job have called MPI_Init.
    mpi.emplace(nullptr, nullptr);
    // For the watch's thread, which asks who is late while this one is inside MPI.
    awaited_ = StartStep::split;
    const MPI_Comm local = split_world(Role::coupler);
    awaited_ = StartStep::announcement;
    return local;
}

// The watch also covers the intercommunicator, which all ranks of the participant create.
JoinedParticipant Joining::meet(MPI_Comm local) {
    // Without a limit of its own: the watch is running.
    return accept_participant(local, std::numeric_limits<double>::infinity());
}

std::vector<StartRecord> Joining::who_has_left() const {
    return left_before(awaited_, run_, roles_, settings_);
}

std::string Joining::who_is_late() const {
    const StartStep awaited = awaited_;
    return late_start_text(awaited, not_yet_at(awaited, run_, roles_, settings_),
                           settings_.real("limits.start"));
}

}  // namespace turbidite
