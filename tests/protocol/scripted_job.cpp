// SPDX-License-Identifier: LGPL-2.1-or-later
//
// All programs of a scripted job in one executable:
//
//     scripted_job coupler FOLDER FLUID_RANKS GRAINS_RANKS [SCHEME]
//     scripted_job fluid   FOLDER [FAULT]
//     scripted_job grains  FOLDER [FAULT]
//
// FAULT occurs in window 2: throw, bad-input, exit, kill, silence. SCHEME is split by default;
// under joint the grains land on a floor and the fluid announces an inertia that is 20 % wrong, so
// that several rounds are needed.
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <thread>

#include "coupler/hub/hub.hpp"
#include "coupler/participant/participant.hpp"
#include "coupler/participant/scripted.hpp"
#include "coupler/transport/intercomm_channel.hpp"
#include "coupler/transport/world.hpp"
#include "tests/unit/coupler/test_case.hpp"

namespace {

using namespace turbidite;

void commit(const std::string& fault) {
    if (fault == "throw") throw PhysicsRefused("scripted trouble");
    if (fault == "bad-input") throw Failure(ExitCode::bad_input, "scripted bad input");
    if (fault == "exit") _exit(0);
    if (fault == "kill") raise(SIGKILL);
    if (fault == "silence") std::this_thread::sleep_for(std::chrono::hours(1));
    throw std::invalid_argument("unknown fault " + fault);
}

Fault in_window_two(const std::string& fault) {
    return [fault](const std::string& function, std::int64_t window) {
        if (!fault.empty() && function == "advance" && window == 2) commit(fault);
    };
}

int couple(const std::string& folder, int fluid_ranks, int grains_ranks,
           const std::string& scheme) {
    Settings settings = test_settings(scheme);
    settings.set("fluid.ranks", std::int64_t{fluid_ranks});
    settings.set("grains.ranks", std::int64_t{grains_ranks});
    settings.set("coupling.iterations", std::int64_t{15});  // 0.02 u_c * 0.2^n < 1e-9 u_c takes 11
    settings.set("limits.stall_soft", 1.0);
    settings.set("limits.stall_hard", 3.0);
    const MPI_Comm local = split_world(Role::coupler);
    std::unique_ptr<IntercommChannel> fluid, grains;
    for (int i = 0; i < 2; ++i) {
        const JoinedParticipant joined = accept_participant(local, 30.0);
        (joined.role == Role::fluid ? fluid : grains) =
            std::make_unique<IntercommChannel>(joined.intercomm);
    }
    const std::filesystem::path root = folder;
    Hub hub({settings, {{"disc", {}}}, test_population()},
            {root / "history.csv", root / "grains", root / "logs/coupler.log", root / "run.json",
             root / "STOP"},
            *grains, fluid.get(), find_scheme(scheme));
    return static_cast<int>(hub.run().code);
}

}  // namespace

int main(int argc, char** argv) {
    const std::string role = argv[1], folder = argv[2];
    const std::string fault = role != "coupler" && argc > 3 ? argv[3] : "";
    if (role == "coupler") {
        MpiEnvironment mpi(&argc, &argv);
        try {
            return couple(folder, std::atoi(argv[3]), std::atoi(argv[4]),
                          argc > 5 ? argv[5] : "split");
        } catch (const Failure& failure) {
            std::fprintf(stderr, "coupler: %s\n", failure.what());
            PMPI_Abort(MPI_COMM_WORLD, static_cast<int>(failure.code()));
        }
    }
    const bool joint = std::getenv("SCRIPTED_JOINT") != nullptr;
    const Launch launch{&argc, &argv, folder};
    if (role == "grains") {
        ScriptedGrains adapter("scripted", in_window_two(fault));
        if (joint) adapter.lay_floor(4.4995);
        return run_grains(adapter, launch);
    }
    // Each rank's slice of the domain follows from its rank within its own program.
    const char* rank = std::getenv("SCRIPTED_FLUID_RANKS");
    const int ranks = rank ? std::atoi(rank) : 1;
    const char* local = std::getenv("OMPI_COMM_WORLD_RANK");
    ScriptedFluid adapter(0.3, (std::atoi(local) - 1) % ranks, ranks, in_window_two(fault));
    if (joint) adapter.misjudge_inertia(0.2);
    return run_fluid(adapter, launch);
}
