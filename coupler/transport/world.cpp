// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/transport/world.hpp"

#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <numeric>
#include <string>
#include <thread>
#include <utility>

#include "coupler/protocol/failure.hpp"
#include "coupler/protocol/files/start_record.hpp"
#include "coupler/transport/channel.hpp"
#include "coupler/transport/doorbell.hpp"

// Of a world_isolation.cpp that is linked or preloaded; null without.
extern "C" [[gnu::weak]] MPI_Comm turbidite_world_split_before();
extern "C" [[gnu::weak]] void turbidite_world_split_now(MPI_Comm local);

namespace turbidite {
namespace {

constexpr const char* job_variable = "PMIX_NAMESPACE";  // PMIx names the jobs of a host
constexpr int first_colour = 1000;  // private: 3 is YADE's, 1 EOF-Library's, small ones APPNUMs
constexpr int announcement_tag = 1000;
constexpr int intercomm_tag = 1010;  // + role

/// Before the intercommunicator, whose other end may ring at once. Within a job nobody else has the
/// name of this process; without mpirun there is no job, and names are not unique.
void install_doorbell() {
    int rank = 0;
    PMPI_Comm_rank(MPI_COMM_WORLD, &rank);
    const std::string name = bell_name(rank);
    if (Doorbell::own().install(name) || std::getenv(job_variable) == nullptr) return;
    std::fprintf(stderr,
                 "turbidite: warning: another process has the doorbell @%s of this one (ss -xlp "
                 "names it); this one looks for messages by itself, which takes longer\n",
                 name.c_str());
}

}  // namespace

MpiEnvironment::MpiEnvironment(int* argc, char*** argv) {
    int running = 0;
    PMPI_Initialized(&running);
    // By the host, e.g. YADE's mpy: then the host also finalises it.
    if (running) return;
    int provided = 0;
    note_start(StartStep::mpi_init);
    // Calls come from one thread at a time, whichever it is.
    PMPI_Init_thread(argc, argv, MPI_THREAD_SERIALIZED, &provided);
    ours_ = true;
}

MpiEnvironment::~MpiEnvironment() {
    int finalized = 0;
    PMPI_Finalized(&finalized);
    if (!ours_ || finalized) return;
    note_start(StartStep::end);
    PMPI_Finalize();
}

MPI_Comm split_world(Role role) {
    note_start(StartStep::split);
    // Where the program has called MPI_Init itself, the isolation of its world has split it there.
    MPI_Comm local = turbidite_world_split_before ? turbidite_world_split_before() : MPI_COMM_NULL;
    if (local != MPI_COMM_NULL) return local;
    PMPI_Comm_split(MPI_COMM_WORLD, first_colour + static_cast<int>(role), 0, &local);
    if (turbidite_world_split_now) turbidite_world_split_now(local);
    return local;
}

MPI_Comm join_coupler(MPI_Comm local, Role role) {
    int rank = 0, ranks = 0;
    PMPI_Comm_rank(local, &rank);
    PMPI_Comm_size(local, &ranks);
    install_doorbell();
    note_start(StartStep::announcement);
    // The leader speaks for its program. It is not known who joins first: each announces itself.
    if (rank == 0) {
        const std::array<int, 2> announcement = {static_cast<int>(role), ranks};
        PMPI_Send(announcement.data(), 2, MPI_INT, 0, announcement_tag, MPI_COMM_WORLD);
    }
    MPI_Comm intercomm = MPI_COMM_NULL;
    // Collective on `local` alone, with the coupler (world rank 0) as the other side's leader. A
    // tag per role, since participants may join at the same time.
    PMPI_Intercomm_create(local, 0, MPI_COMM_WORLD, 0, intercomm_tag + static_cast<int>(role),
                          &intercomm);
    return intercomm;
}

JoinedParticipant accept_participant(MPI_Comm local, double limit) {
    MPI_Status status;
    int arrived = 0;
    install_doorbell();
    // Probed and not received: a receive could not be given up, and would take the core from
    // others.
    for (Patience patience; !arrived; patience.wait()) {
        PMPI_Iprobe(MPI_ANY_SOURCE, announcement_tag, MPI_COMM_WORLD, &arrived, &status);
        if (!arrived && patience.seconds() > limit)
            throw Failure(ExitCode::stalled, "no participant connected within " +
                                                 std::to_string(static_cast<int>(limit)) +
                                                 " s; see the participants' logs in logs/");
    }
    std::array<int, 2> announcement{};
    PMPI_Recv(announcement.data(), 2, MPI_INT, status.MPI_SOURCE, announcement_tag, MPI_COMM_WORLD,
              MPI_STATUS_IGNORE);
    JoinedParticipant joined;
    joined.role = static_cast<Role>(announcement[0]);
    joined.ranks = announcement[1];
    PMPI_Intercomm_create(local, 0, MPI_COMM_WORLD, status.MPI_SOURCE,
                          intercomm_tag + announcement[0], &joined.intercomm);
    return joined;
}

std::vector<int> world_ranks_of_peers(MPI_Comm intercomm) {
    MPI_Group peers = MPI_GROUP_NULL, world = MPI_GROUP_NULL;
    PMPI_Comm_remote_group(intercomm, &peers);
    PMPI_Comm_group(MPI_COMM_WORLD, &world);
    int count = 0;
    PMPI_Group_size(peers, &count);
    std::vector<int> there(static_cast<std::size_t>(count)), ranks(there.size());
    std::iota(there.begin(), there.end(), 0);
    // In the order of the ranks at the other end, as send(peer) counts them.
    PMPI_Group_translate_ranks(peers, count, there.data(), world, ranks.data());
    PMPI_Group_free(&peers);
    PMPI_Group_free(&world);
    return ranks;
}

std::string bell_name(int world_rank) {
    const char* job = std::getenv(job_variable);
    return std::string("turbidite/") + (job ? job : "") + "/" + std::to_string(world_rank);
}

struct StartWatch::State {
    std::mutex use;  // of what the callbacks refer to: held while they are asked
    bool armed = true;
};

StartWatch::StartWatch(double limit, std::function<bool()> hopeless,
                       std::function<ExitCode()> expired)
    : state_(std::make_shared<State>()) {
    // Detached, and with a share of the state: it may outlive the watch by one sleep of 50 ms.
    std::thread([state = state_, limit, hopeless = std::move(hopeless),
                 expired = std::move(expired)] {
        using Clock = std::chrono::steady_clock;
        const auto end = Clock::now() + std::chrono::duration<double>(limit);
        auto ask = Clock::now() + std::chrono::seconds(1);
        for (bool given_up = false; !given_up;) {
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
            const std::scoped_lock lock(state->use);
            if (!state->armed) return;
            given_up = Clock::now() >= end;
            if (Clock::now() >= ask) {
                given_up = given_up || hopeless();
                ask = Clock::now() + std::chrono::seconds(1);
            }
            // Without the handlers of exit(): the main thread hangs inside MPI.
            if (given_up) _exit(static_cast<int>(expired()));
        }
    }).detach();
}

StartWatch::~StartWatch() {
    disarm();
}
void StartWatch::disarm() {
    const std::scoped_lock lock(state_->use);
    state_->armed = false;
}

}  // namespace turbidite
