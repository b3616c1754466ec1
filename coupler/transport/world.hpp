// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Connects the programs of one MPMD job.
//
// Every process takes part in exactly one MPI_Comm_split of the world (colour 1000 + role, or the
// split that yade.mpy makes by itself), the only collective operation on the world. Then the leader
// of each participant announces itself to the coupler, world rank 0, and both create an
// intercommunicator.
#pragma once

#include <mpi.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "coupler/protocol/failure.hpp"
#include "coupler/protocol/hello.hpp"

namespace turbidite {

/// MPI for the lifetime of a program: initialises it (thread level serialized) unless this has been
/// done, and finalises it unless other code will.
class MpiEnvironment {
 public:
    MpiEnvironment(int* argc, char*** argv);
    ~MpiEnvironment();
    MpiEnvironment(const MpiEnvironment&) = delete;
    MpiEnvironment& operator=(const MpiEnvironment&) = delete;

    /// MPI is not finalised: the program ends in the middle of a run, and MPI_Finalize would wait
    /// for others that wait for it.
    void abandon() { ours_ = false; }

 private:
    bool ours_ = false;  ///< to finalise
};

/// Makes the single split and returns this program's own communicator.
MPI_Comm split_world(Role role);

/// A participant: announces `local` to the coupler and returns the intercommunicator to it.
MPI_Comm join_coupler(MPI_Comm local, Role role);

/// The coupler: one participant that has announced itself.
struct JoinedParticipant {
    Role role = Role::grains;
    int ranks = 0;
    MPI_Comm intercomm = MPI_COMM_NULL;
};

/// The coupler: waits for the next announcement. Throws Failure (stalled) after `limit` seconds.
JoinedParticipant accept_participant(MPI_Comm local, double limit);

/// The world ranks of the processes at the other end.
std::vector<int> world_ranks_of_peers(MPI_Comm intercomm);

/// The doorbell of a process of this job, which is there as soon as it has an intercommunicator.
std::string bell_name(int world_rank);

/// Ends a job that hangs during its start: unless `disarm`ed within `limit` seconds, or until
/// `hopeless`, the process calls `expired` and exits with the code that it returns, which makes
/// mpirun end the job. Used for the waits that cannot be polled: MPI_Init and the split of the
/// world.
class StartWatch {
 public:
    StartWatch(double limit, std::function<bool()> hopeless, std::function<ExitCode()> expired);
    ~StartWatch();
    void disarm();

 private:
    struct State;
    std::shared_ptr<State> state_;
};

}  // namespace turbidite
