// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/participant/participant.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "coupler/protocol/case_hash.hpp"
#include "coupler/protocol/files/run_files.hpp"
#include "coupler/protocol/files/start_record.hpp"
#include "coupler/transport/intercomm_channel.hpp"
#include "coupler/transport/world.hpp"

namespace turbidite {
namespace {

// Redirects both streams into one file, at the level of file descriptors, so that output of the
// host code and of Python is included. turbidite-member has done so already.
void redirect_output(const std::string& file) {
    if (std::getenv(member_variable) != nullptr) return;
    std::filesystem::create_directories(std::filesystem::path(file).parent_path());
    const int log = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (log < 0) throw Failure(ExitCode::participant_failed, "cannot write the log " + file);
    std::fflush(nullptr);
    dup2(log, STDOUT_FILENO);
    dup2(log, STDERR_FILENO);
    close(log);
}

std::string hash_of_run(const std::string& run_folder) {
    std::ifstream file(run_folder + "/case.yaml", std::ios::binary);
    if (!file) return {};
    return case_hash({std::istreambuf_iterator<char>(file), {}});
}

/// Throws Failure where this program is alone, or first, in its job: the coupler is world rank 0.
void require_coupler(Role role, MPI_Comm local) {
    int place = 0, all = 0, own = 0;
    PMPI_Comm_rank(MPI_COMM_WORLD, &place);
    PMPI_Comm_size(MPI_COMM_WORLD, &all);
    PMPI_Comm_size(local, &own);
    if (place > 0 && own < all) return;
    throw Failure(ExitCode::bad_input,
                  std::string("there is no coupler in this job: programs that play the ") +
                      role_name(role) +
                      " are started by `turbidite run`, with grains.command or fluid.program, and "
                      "by `turbidite adapter-test`");
}

/// Throws Failure if the folder is none of a run: the library reads and writes there. A job that
/// the launcher has not made need not have one.
void require_run_folder(const std::string& folder) {
    if (std::getenv(member_variable) == nullptr) return;
    if (std::error_code none; std::filesystem::exists(folder + "/case.yaml", none)) return;
    throw Failure(ExitCode::participant_failed,
                  "\"" + folder +
                      "\" is no run folder, it has no case.yaml: give the library the last word of "
                      "the command line");
}

MPI_Comm own_communicator(Role role, std::uintptr_t given) {
    // A host that has split the world already, as YADE's mpy does, gives its own communicator.
    if (given == 0) return split_world(role);
    return reinterpret_cast<MPI_Comm>(given);  // Open MPI's handles are pointers
}

}  // namespace

struct Membership::State {
    State(Role role_, const Launch& launch)
        : role(role_),
          mpi(launch.argc, launch.argv),
          local(own_communicator(role_, launch.communicator)) {
        // Before a log is written: it might be that of a finished run.
        require_coupler(role, local);
        PMPI_Comm_rank(local, &rank);
        PMPI_Comm_size(local, &ranks);
        run_folder = launch.run_folder;
        // turbidite-member names it by the place in the job; this one, of rank and size, by the
        // place in the program's own communicator.
        log = started_log();
        if (log.empty()) log = log_file(run_folder, role, rank, ranks);
        redirect_output(log);
        hash = hash_of_run(launch.run_folder);
        // The ranks of this program may talk to each other from here on, before the coupler is met.
        if (launch.joined) call(launch.joined);
        channel = std::make_unique<IntercommChannel>(join_coupler(local, role));
    }

    void call(const std::function<void(int)>& joined) {
        try {
            joined(MPI_Comm_c2f(local));
        } catch (...) {
            mpi.abandon();
            throw;
        }
    }

    Role role;
    MpiEnvironment mpi;
    MPI_Comm local;
    int rank = 0;
    int ranks = 1;
    std::string run_folder;
    std::string log;
    std::string hash;
    std::unique_ptr<IntercommChannel> channel;
    bool over = false;  ///< the run, for this program
};

Membership::Membership(Role role, const Launch& launch)
    : state_(std::make_unique<State>(role, launch)) {}

/// In the middle of a run, as where a host's own loop has thrown: what it says, and its end, are
/// then told by turbidite-member.
Membership::~Membership() {
    if (state_->over) return;
    std::fprintf(stderr, "turbidite: %s: has left before the run was over\n",
                 role_name(state_->role));
    state_->mpi.abandon();
}

Channel& Membership::channel() {
    return *state_->channel;
}

Identity Membership::identity() const {
    return {state_->rank, state_->ranks, state_->log, state_->hash, state_->run_folder};
}

int Membership::leave(const Outcome& outcome) {
    const int code = static_cast<int>(outcome.code);
    state_->over = true;
    if (outcome.code != ExitCode::done)
        std::fprintf(stderr, "turbidite: the run ended with code %d: %s\n", code,
                     outcome.reason.c_str());
    std::fflush(nullptr);
    return code;
}

// A normal exit would wait in MPI_Finalize for programs that wait for this one.
void Membership::abort(const std::exception& error) {
    const auto code = static_cast<int>(code_of(error));
    std::fprintf(stderr, "turbidite: %s: %s\n", role_name(state_->role), error.what());
    std::fflush(nullptr);
    // Before the abort, after which mpirun reports nothing but a code.
    write_first_end(state_->run_folder,
                    {static_cast<ExitCode>(code), rank_name(state_->role, state_->rank),
                     std::string("gave up: ") + error.what()});
    // Of the real world: the whole job ends.
    PMPI_Abort(MPI_COMM_WORLD, code);
    _exit(code);
}

namespace {

template <class Adapter>
int play(Role role, Adapter& adapter, const Launch& launch) {
    require_run_folder(launch.run_folder);
    Membership membership(role, launch);
    const auto session = make_session(adapter, membership.channel(), membership.identity());
    try {
        for (bool going = session->start(); going; going = session->step()) {
        }
        return membership.leave(session->outcome());
    } catch (const std::exception& error) {
        membership.abort(error);
    }
}

/// What fails before the coupler knows this program ends it, Launch::joined as well:
/// turbidite-member tells the others.
template <class Adapter>
int run(Role role, Adapter& adapter, const Launch& launch) {
    try {
        return play(role, adapter, launch);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "turbidite: %s: %s\n", role_name(role), error.what());
        return static_cast<int>(code_of(error));
    }
}

}  // namespace

int run_grains(GrainsAdapter& adapter, const Launch& launch) {
    return run(Role::grains, adapter, launch);
}

int run_fluid(FluidAdapter& adapter, const Launch& launch) {
    return run(Role::fluid, adapter, launch);
}

}  // namespace turbidite
