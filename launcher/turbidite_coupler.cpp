// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite-coupler RUN [SET]: the coupler of a job, world rank 0. RUN is a folder prepared by
// `turbidite run`, SET the name of a checkpoint in it from which the run goes on.
#include <fmt/format.h>

#include <csignal>
#include <cstdio>
#include <memory>
#include <optional>
#include <vector>

#include "coupler/hub/hub.hpp"
#include "coupler/protocol/files/freed_memory.hpp"
#include "coupler/transport/intercomm_channel.hpp"
#include "coupler/transport/joining.hpp"
#include "coupler/transport/recording.hpp"
#include "launcher/case/case_file.hpp"
#include "launcher/case/files/run_folder.hpp"
#include "launcher/job/folder/claim.hpp"

namespace {

using namespace turbidite;

volatile std::sig_atomic_t ended_from_outside = 0;
volatile std::sig_atomic_t asked_to_stop = 0;

struct Meeting {
    std::unique_ptr<IntercommChannel> grains, fluid;
};

std::vector<Role> participants(bool with_fluid) {
    return with_fluid ? std::vector{Role::fluid, Role::grains} : std::vector{Role::grains};
}

Meeting meet_participants(Joining& joining, MPI_Comm local, bool with_fluid) {
    Meeting meeting;
    for (auto missing = participants(with_fluid).size(); missing > 0; --missing) {
        const JoinedParticipant joined = joining.meet(local);
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
    return {folder.history(), folder.grains(), folder.log("coupler"), folder.record(), folder.root};
}

CouplerState coupler_state(const Bytes& bytes, const std::string& set) {
    try {
        return decode<CouplerState>(bytes);
    } catch (const MalformedPayload& fault) {
        throw Failure(ExitCode::participant_failed,
                      fmt::format("{}/coupler: {}. Was it written by another version?",
                                  CheckpointSets::folder(set), fault.what()));
    }
}

std::optional<Resumption> resumption(const std::string& directory, const std::string& set,
                                     const Settings& settings) {
    if (set.empty()) return std::nullopt;
    const Manifest manifest = CheckpointSets(directory).manifest(set);
    const Bytes bytes =
        load(std::filesystem::path(directory) / CheckpointSets::folder(set), manifest.coupler);
    Resumption resumed{set, coupler_state(bytes, set)};
    const auto ranks = static_cast<std::size_t>(settings.integer("grains.ranks"));
    if (manifest.grains.size() != ranks) share_out(resumed.state, static_cast<int>(ranks));
    return resumed;
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

Meeting join(const std::string& directory, const Settings& settings,
             std::optional<MpiEnvironment>& mpi) {
    const bool with_fluid = settings.flag("fluid.enabled");
    Joining joining(directory, settings, participants(with_fluid),
                    [&](ExitCode code, const std::string& text) {
                        std::fprintf(stderr, "turbidite: %s\n", text.c_str());
                        record_failure(directory, code, text);
                    });
    return meet_participants(joining, joining.join_world(mpi), with_fluid);
}

/// The channel itself, or one that records it.
class MaybeRecorded {
 public:
    MaybeRecorded(Channel* channel, const ResolvedCase& resolved, const RunFolder& folder,
                  Role role)
        : channel_(channel) {
        const std::string& wanted = resolved.settings.text("coupling.recording");
        const std::string name = role_name(role);
        if (channel && (wanted == "both" || wanted == name))
            channel_ = &recording_.emplace(*channel, folder.recording(name), [](const auto& text) {
                std::fprintf(stderr, "turbidite: warning: %s\n", text.c_str());
            });
    }
    Channel* channel() { return channel_; }

 private:
    std::optional<RecordingChannel> recording_;
    Channel* channel_;
};

RunStatus couple(const std::string& directory, const std::string& set,
                 std::optional<MpiEnvironment>& mpi) {
    ResolvedCase resolved = load_run_folder(directory);
    Meeting meeting = join(directory, resolved.settings, mpi);
    const RunFolder folder{directory};
    MaybeRecorded grains(meeting.grains.get(), resolved, folder, Role::grains);
    MaybeRecorded fluid(meeting.fluid.get(), resolved, folder, Role::fluid);
    Hub hub({resolved.settings, resolved.shapes, resolved.population,
             resumption(directory, set, resolved.settings)},
            hub_files(folder), *grains.channel(), fluid.channel(),
            find_scheme(resolved.settings.text("run.scheme")));
    std::signal(SIGTERM, [](int) { ended_from_outside = 1; });
    hub.end_on(ended_from_outside);
    std::signal(SIGUSR1, [](int) { asked_to_stop = 1; });
    hub.stop_on(asked_to_stop);
    return hub.run();
}

// `mpi` belongs to the caller: after a failure the job is aborted, and finalising MPI while the
// exception is on its way would wait for the others.
int main_program(const std::string& directory, const std::string& set,
                 std::optional<MpiEnvironment>& mpi) try {
    return static_cast<int>(couple(directory, set, mpi).code);
} catch (const EndedFromOutside&) {
    std::signal(SIGTERM, SIG_DFL);
    std::raise(SIGTERM);
    return static_cast<int>(ExitCode::terminated);
} catch (const std::exception& error) {
    const ExitCode code = code_in_job(code_of(error));
    std::fprintf(stderr, "turbidite-coupler: %s\n", error.what());
    std::fflush(nullptr);
    record_failure(directory, code, error.what());
    if (mpi) PMPI_Abort(MPI_COMM_WORLD, static_cast<int>(code));
    return static_cast<int>(code);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2 && argc != 3) {
        std::fprintf(stderr, "usage: turbidite-coupler RUN [SET]   (started by `turbidite run`)\n");
        return static_cast<int>(ExitCode::bad_input);
    }
    keep_freed_memory();
    const std::string directory = argv[1], set = argc == 3 ? argv[2] : "";
    std::shared_ptr<RunLock> lock;
    try {
        lock = claim(RunFolder{directory}, set);
    } catch (const Failure& failure) {
        // Not recorded in a folder that is another's, or has its own outcome.
        std::fprintf(stderr, "turbidite-coupler: %s\n", failure.what());
        return static_cast<int>(failure.code());
    }
    std::optional<MpiEnvironment> mpi;
    return main_program(directory, set, mpi);
}
