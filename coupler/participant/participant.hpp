// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// What the `main` of a participant needs: everything between the command line and the exit code.
///
///     int main(int argc, char** argv) {
///         MyAdapter adapter;
///         return turbidite::run_grains(adapter, {&argc, &argv, run_folder});
///     }
///
/// Output goes to `RUN/logs/ROLE.log` (one file per rank when there are several).
/// Valid C++17; includes neither MPI nor any host.
#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <string>

#include "coupler/participant/adapter.hpp"
#include "coupler/participant/session.hpp"

namespace turbidite {

/// What the command line has told.
struct Launch {
    int* argc = nullptr;     ///< of `main`, for MPI_Init; may be null
    char*** argv = nullptr;  ///< likewise
    std::string run_folder;  ///< the last word of the command line
    /// A communicator that the host code has already split off the world (as YADE's mpy does), as
    /// the integer that mpi4py calls its handle; 0: the library makes the split.
    std::uintptr_t communicator = 0;
    /// Called once with the Fortran handle of the participant's own communicator (MPI_Comm_f2c),
    /// before any call of the adapter: for messages between its ranks, or to isolate a host code's
    /// world.
    std::function<void(int)> joined = {};
};

/// One rank's place in the job: its communicator, its channel to the coupler, its log. For hosts
/// with a loop of their own; others call run_grains().
class Membership {
 public:
    /// Joins the job: MPI_Init unless MPI runs already, the one split of the world, then the
    /// intercommunicator. Blocks until the coupler has accepted. Throws Failure if there is no
    /// coupler in the job, as where the program was started by hand, or the log cannot be written.
    Membership(Role role, const Launch& launch);
    ~Membership();

    Channel& channel();         ///< to the coupler, for make_session()
    Identity identity() const;  ///< for make_session()

    /// After the farewell: writes the final messages and returns the exit code of the program. MPI
    /// is finalised with this object; without this call, as where the host has thrown, it is not,
    /// and the program is to end, which ends the job.
    int leave(const Outcome& outcome);

    /// The coupler no longer answers: prints the reason and aborts the whole job.
    [[noreturn]] void abort(const std::exception& error);

 private:
    struct State;
    std::unique_ptr<State> state_;
};

/// The whole life of a grains program: joins the job, makes the calls of the adapter until the run
/// is over, and finalises MPI if it has initialised it. Returns the exit code of the program
/// (ExitCode), in words on stderr where it cannot join. If the coupler no longer answers it aborts
/// the whole job and does not return.
int run_grains(GrainsAdapter& adapter, const Launch& launch);

/// The same for a fluid.
int run_fluid(FluidAdapter& adapter, const Launch& launch);

}  // namespace turbidite
