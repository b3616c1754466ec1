// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite-bench-coupling: the programs of a job in which only the coupling works.
//
//     coupler FOLDER CASE --grains N --windows W [--ranks F,G]
//     fluid   FOLDER [--ranks F]       grains FOLDER [--pause SECONDS]
//     relay   FOLDER --bytes B --turns T          three ranks, without coupler
//
// Every rank writes ROLE.RANK.stamps (stamps.hpp) and ROLE.RANK.json (a Sample: processor and wall
// time from the first to the last window, bytes moved per window, peak memory) into FOLDER.
#include <fmt/format.h>
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <thread>

#include "bench/coupling/relay.hpp"
#include "bench/coupling/stamped_channel.hpp"
#include "bench/timing/step_clock.hpp"
#include "coupler/hub/hub.hpp"
#include "coupler/participant/participant.hpp"
#include "coupler/participant/scripted.hpp"
#include "coupler/protocol/files/freed_memory.hpp"
#include "coupler/transport/intercomm_channel.hpp"
#include "coupler/transport/world.hpp"
#include "launcher/case/case_file.hpp"

namespace turbidite::bench {
namespace {

namespace fs = std::filesystem;

struct Options {
    std::string role;
    fs::path folder, the_case;
    std::int64_t grains = 1400, windows = 10, bytes = 0;
    int fluid_ranks = 1, grains_ranks = 1, turns = 1;
    double pause = 0.0;  ///< of the grains program, in every window [s]
};

constexpr double drag = 0.3;      // of the scripted fluid
constexpr double spacing = 1.25;  // [D] between the centres of neighbours

/// Discs on a square lattice in a box with room to fall, in the run's units of length.
std::vector<GrainState> square_lattice(std::int64_t count, const RunValues& run) {
    const auto columns = static_cast<std::int64_t>(std::ceil(std::sqrt(count)));
    std::vector<GrainState> grains(static_cast<std::size_t>(count));
    for (std::int64_t i = 0; i < count; ++i) {
        GrainState& grain = grains[static_cast<std::size_t>(i)];
        grain.id = i;
        grain.radius = 0.5 * run.diameter;
        grain.density = 1.5 * run.fluid_density;
        grain.position = {(i % columns + 1) * spacing * run.diameter,
                          (i / columns + 2) * spacing * run.diameter, 0.0};
    }
    return grains;
}

Settings settings_for(const Options& o) {
    const double size = spacing * (std::ceil(std::sqrt(o.grains)) + 3.0);
    return load_case(o.the_case, {fmt::format("domain.size=[{0},{0}]", std::ceil(size)),
                                  fmt::format("fluid.ranks={}", o.fluid_ranks), "limits.memory=1e6",
                                  fmt::format("grains.ranks={}", o.grains_ranks),
                                  fmt::format("time.end={}", 0.001 * o.windows)})
        .settings;
}

/// Peak resident memory of this process [bytes].
double peak_bytes() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

/// What one rank did, from its first message of window 1 to its last one of any window.
Sample summary(const std::vector<Stamp>& stamps) {
    Sample sample;
    sample.resident = peak_bytes();
    const Stamp *first = nullptr, *last = nullptr;
    for (const Stamp& stamp : stamps) {
        if (stamp.window < 1) continue;
        if (!first) first = &stamp;
        last = &stamp;
        if (stamp.window == 1)
            sample.counts[stamp.sent ? "sent" : "received"] += static_cast<double>(stamp.bytes);
    }
    if (!first) throw Failure(ExitCode::bad_input, "--windows: at least 2");
    sample.processor = last->processor - first->processor;
    sample.wall = last->end - first->begin;
    return sample;
}

void write_results(const std::vector<Stamp>& stamps, const Options& options, int rank) {
    const auto name = (options.folder / fmt::format("{}.{}", options.role, rank)).string();
    write_sample(summary(stamps), name + ".json");
    write_stamps(stamps, name + ".stamps");
}

// `mpi` belongs to the caller: finalising MPI while an exception is on its way would wait for the
// other programs.
int couple(const Options& options, std::optional<MpiEnvironment>& mpi) {
    mpi.emplace(nullptr, nullptr);
    std::vector<Stamp> stamps;
    const Settings settings = settings_for(options);
    const MPI_Comm local = split_world(Role::coupler);
    std::unique_ptr<IntercommChannel> fluid, grains;
    for (int i = 0; i < 2; ++i) {
        const JoinedParticipant joined = accept_participant(local, 60.0);
        (joined.role == Role::fluid ? fluid : grains) =
            std::make_unique<IntercommChannel>(joined.intercomm);
    }
    StampedChannel to_fluid(*fluid, stamps), to_grains(*grains, stamps);
    const fs::path& root = options.folder;
    Hub hub({settings, {{"disc", {}}}, square_lattice(options.grains, run_values(settings))},
            {root / "history.csv", root / "grains", root / "coupler.log", root / "run.json", root},
            to_grains, &to_fluid, find_scheme("split"));
    const RunStatus status = hub.run();
    write_results(stamps, options, 0);
    return static_cast<int>(status.code);
}

template <class Adapter>
int take_part(Adapter& adapter, Role role, const Options& options) {
    Membership membership(role, {.run_folder = options.folder});
    std::vector<Stamp> stamps;
    StampedChannel channel(membership.channel(), stamps);
    const auto session = make_session(adapter, channel, membership.identity());
    try {
        for (bool going = session->start(); going; going = session->step()) {
        }
        write_results(stamps, options, membership.identity().rank);
        return membership.leave(session->outcome());
    } catch (const std::exception& error) {
        membership.abort(error);
    }
}

int take_part_as_grains(const Options& options) {
    ScriptedGrains adapter("scripted", [&](const std::string& function, std::int64_t) {
        if (function == "advance")
            std::this_thread::sleep_for(std::chrono::duration<double>(options.pause));
    });
    return take_part(adapter, Role::grains, options);
}

int take_part_as_fluid(const Options& options) {
    const char* world_rank = std::getenv("OMPI_COMM_WORLD_RANK");  // the coupler's is 0
    ScriptedFluid adapter(drag, std::atoi(world_rank ? world_rank : "1") - 1, options.fluid_ranks);
    return take_part(adapter, Role::fluid, options);
}

int relay(const Options& options, std::optional<MpiEnvironment>& mpi) {
    mpi.emplace(nullptr, nullptr);
    const std::vector<double> seconds = relayed(options.bytes, options.turns);
    if (seconds.empty()) return 0;
    Sample sample;
    sample.wall = median({seconds.begin() + 1, seconds.end()});  // the first touches the memory
    write_sample(sample, options.folder / "relay.json");
    return 0;
}

int play(const Options& options, std::optional<MpiEnvironment>& mpi) {
    keep_freed_memory();  // as the programs of a run do
    if (options.role == "coupler") return couple(options, mpi);
    if (options.role == "fluid") return take_part_as_fluid(options);
    if (options.role == "grains") return take_part_as_grains(options);
    return relay(options, mpi);
}

}  // namespace
}  // namespace turbidite::bench

int main(int argc, char** argv) {
    turbidite::bench::Options options;
    CLI::App app{"The programs of `turbidite bench coupling`", "turbidite-bench-coupling"};
    app.add_option("ROLE", options.role)
        ->required()
        ->check(CLI::IsMember({"coupler", "fluid", "grains", "relay"}));
    app.add_option("FOLDER", options.folder, "for the results")->required();
    app.add_option("CASE", options.the_case, "the coupler: bench/coupling.yaml");
    app.add_option("--grains", options.grains, "number of discs");
    app.add_option("--windows", options.windows, "to play");
    app.add_option("--fluid-ranks", options.fluid_ranks, "of the whole job");
    app.add_option("--grains-ranks", options.grains_ranks, "of the whole job");
    app.add_option("--pause", options.pause, "of the grains in every window [s]");
    app.add_option("--bytes", options.bytes, "per turn of the relay");
    app.add_option("--turns", options.turns, "of the relay");
    CLI11_PARSE(app, argc, argv);
    std::optional<turbidite::MpiEnvironment> mpi;
    try {
        return turbidite::bench::play(options, mpi);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "turbidite-bench-coupling: %s\n", error.what());
        std::_Exit(static_cast<int>(turbidite::ExitCode::participant_failed));  // ends the job
    }
}
