// SPDX-License-Identifier: LGPL-2.1-or-later
//
// latecomer STEP RUN: a grains program that goes no further than this step of its start, and then
// neither ends nor says a word: init (MPI_Init), split (of the world), announcement (and the
// intercommunicator, but no hello). With leave it goes to MPI_Finalize instead of the split.
#include <mpi.h>
#include <unistd.h>

#include <cstdio>
#include <string>

#include "coupler/transport/world.hpp"

namespace {

using namespace turbidite;

[[noreturn]] void fall_silent() {
    for (;;) pause();
}

}  // namespace

int main(int argc, char** argv) {
    const std::string step = argc > 1 ? argv[1] : "";
    std::fprintf(stderr, "no further than %s\n", step.c_str());
    if (step == "leave") {
        const MpiEnvironment mpi(&argc, &argv);
        return 1;
    }
    MPI_Init(&argc, &argv);
    if (step == "init") fall_silent();
    const MPI_Comm local = split_world(Role::grains);
    if (step == "split") fall_silent();
    join_coupler(local, Role::grains);
    fall_silent();
}
