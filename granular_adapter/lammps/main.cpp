// SPDX-License-Identifier: GPL-2.0-or-later
//
// turbidite-lammps RUN: molecular dynamics of LAMMPS as a participant, on any number of ranks.
#include <mpi.h>

#include <cstdio>

#include "coupler/participant/participant.hpp"
#include "granular_adapter/lammps/lammps_md_host.hpp"
#include "granular_adapter/md/md_adapter.hpp"

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: turbidite-lammps RUN   (started by `turbidite run`)\n");
        return static_cast<int>(turbidite::ExitCode::bad_input);
    }
    turbidite::lammps::LammpsMdHost host;
    turbidite::MdAdapter adapter("lammps-md", host);
    turbidite::Launch launch{&argc, &argv, argv[1]};
    launch.joined = [&host](int communicator) { host.join(MPI_Comm_f2c(communicator)); };
    return turbidite::run_grains(adapter, launch);
}
