// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// A layer between MPI and a host code that assumes it owns MPI_COMM_WORLD: the calls in
/// `world_isolation.cpp` use the communicator set here. Linked ahead of libmpi (or preloaded), it
/// lets an unchanged OpenFOAM take part in a job of several programs. Valid C++17.
#pragma once

#include <mpi.h>

namespace turbidite {

/// From now on the host's world is `local`. Without this call the layer itself splits off the
/// processes with the same role, at MPI_Init: role from TURBIDITE_ROLE (a number), for preloading
/// into stock programs.
void isolate_world(MPI_Comm local);

}  // namespace turbidite
