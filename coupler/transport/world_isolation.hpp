// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A layer between a host code that believes it owns MPI_COMM_WORLD and MPI itself: the calls of
// `world_isolation.cpp` are answered with the communicator set here. Linked ahead of libmpi (or
// preloaded), it lets an unchanged OpenFOAM take part in a job of several programs. Valid C++17.
#pragma once

#include <mpi.h>

namespace turbidite {

/// From now on the host's world is `local`. Without this call the layer splits off the processes
/// with the same role itself, at MPI_Init: role from TURBIDITE_ROLE (a number), for preloading
/// stock programs.
void isolate_world(MPI_Comm local);

}  // namespace turbidite
