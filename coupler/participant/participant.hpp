// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the `main` of a participant needs: everything between the command line and the exit code.
//
//     int main(int argc, char** argv) {
//         MyAdapter adapter;
//         return turbidite::run_grains(adapter, {&argc, &argv, run_folder});
//     }
//
// Output goes to RUN/logs/<role>.log (one file per rank when there are several).
// Valid C++17; includes neither MPI nor any host.
#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <string>

#include "coupler/participant/adapter.hpp"
#include "coupler/participant/session.hpp"

namespace turbidite {

struct Launch {
    int* argc = nullptr;
    char*** argv = nullptr;
    std::string run_folder;
    /// A communicator that the host code has already split off the world (as YADE's mpy does), as
    /// the integer that mpi4py calls its handle; 0: the library makes the split.
    std::uintptr_t communicator = 0;
    /// Called once with the Fortran handle of the participant's own communicator, before any call
    /// of the adapter: used to isolate a host code's world.
    std::function<void(int)> joined = {};
};

/// One rank's place in the job: its communicator, its channel to the coupler, its log.
class Membership {
 public:
    /// Joins the job: the one split of the world, then the intercommunicator. Blocks until the
    /// coupler has accepted.
    Membership(Role role, const Launch& launch);
    ~Membership();

    Channel& channel();
    Identity identity() const;

    /// After the farewell: writes the final messages and returns the exit code of the program. MPI
    /// is finalised with this object.
    int leave(const Outcome& outcome);

    /// The coupler no longer answers: prints the reason and aborts the whole job.
    [[noreturn]] void abort(const std::exception& error);

 private:
    struct State;
    std::unique_ptr<State> state_;
};

/// The whole life of a participant. Returns the exit code of the program.
int run_grains(GrainsAdapter& adapter, const Launch& launch);
int run_fluid(FluidAdapter& adapter, const Launch& launch);

}  // namespace turbidite
