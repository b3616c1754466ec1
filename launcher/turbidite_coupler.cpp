// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite-coupler RUN: the coupler of a job, world rank 0. RUN is a folder prepared by `turbidite
// run`.
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <vector>

#include "coupler/hub/hub.hpp"
#include "coupler/transport/intercomm_channel.hpp"
#include "coupler/transport/world.hpp"
#include "launcher/case/case_file.hpp"
#include "launcher/case/run_folder.hpp"

namespace {

using namespace turbidite;

// Starting a host code takes seconds; after two minutes of silence it is assumed to have failed
// [s].
constexpr double start_limit = 120.0;

struct Meeting {
    std::unique_ptr<IntercommChannel> grains, fluid;
};

Meeting meet_participants(MPI_Comm local, bool with_fluid) {
    Meeting meeting;
    for (int missing = with_fluid ? 2 : 1; missing > 0; --missing) {
        const JoinedParticipant joined = accept_participant(local, start_limit);
        auto& place = joined.role == Role::fluid ? meeting.fluid : meeting.grains;
        if (place || (joined.role == Role::fluid && !with_fluid))
            throw Failure(
                ExitCode::handshake_refused,
                fmt::format("one {} participant too many in the job", role_name(joined.role)));
        place = std::make_unique<IntercommChannel>(joined.intercomm);
    }
    return meeting;
}

HubFiles hub_files(const RunFolder& folder) {
    return {folder.history(), folder.grains(), folder.log("coupler"), folder.record(),
            folder.stop()};
}

RunStatus couple(const std::string& directory) {
    ResolvedCase resolved = load_run_folder(directory);
    StartWatch watch(start_limit, "not all programs of the job started; see the logs");
    const MPI_Comm local = split_world(Role::coupler);
    watch.disarm();
    Meeting meeting = meet_participants(local, resolved.settings.flag("fluid.enabled"));
    Hub hub({resolved.settings, resolved.shapes, resolved.population},
            hub_files(RunFolder{directory}), *meeting.grains, meeting.fluid.get(),
            find_scheme(resolved.settings.text("run.scheme")));
    return hub.run();
}

// If the hub has run, it has written its own, more complete record.
void record_failure(const std::string& directory, ExitCode code, const std::string& reason) {
    const auto record = RunFolder{directory}.record();
    if (!std::filesystem::exists(record) || has_verdict(record)) return;
    RunStatus status;
    status.code = code;
    status.reason = reason;
    try {
        write_run_record(record, status, {});
    } catch (const std::exception& error) {
        std::fprintf(stderr, "turbidite-coupler: %s\n", error.what());
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: turbidite-coupler RUN   (started by `turbidite run`)\n");
        return static_cast<int>(ExitCode::bad_input);
    }
    MpiEnvironment mpi(&argc, &argv);
    ExitCode code = ExitCode::participant_failed;
    try {
        code = couple(argv[1]).code;
    } catch (const std::exception& error) {
        const auto* failure = dynamic_cast<const Failure*>(&error);
        if (failure) code = failure->code();
        std::fprintf(stderr, "turbidite-coupler: %s\n", error.what());
        std::fflush(nullptr);
        record_failure(argv[1], code, error.what());
        PMPI_Abort(MPI_COMM_WORLD, static_cast<int>(code));
    }
    return static_cast<int>(code);
}
