// SPDX-License-Identifier: LGPL-2.1-or-later
//
// PMPI wrappers for the calls that OpenFOAM's libPstream makes (a test compares this list with the
// installed library). Each replaces MPI_COMM_WORLD by the program's own communicator; MPI_Abort
// uses the real world, since a failure must end the whole job.
#include "coupler/transport/world_isolation.hpp"

#include <cstdlib>

namespace {

MPI_Comm own_world = MPI_COMM_NULL;

/// When preloaded into a stock program, isolate_world is not called.
const char* preloaded_role() {
    return std::getenv("TURBIDITE_ROLE");
}

MPI_Comm isolated(MPI_Comm comm) {
    // Before the split the world is still the real one.
    return comm == MPI_COMM_WORLD && own_world != MPI_COMM_NULL ? own_world : comm;
}

void split_if_asked() {
    const char* role = preloaded_role();
    if (own_world == MPI_COMM_NULL && role != nullptr)
        // The one collective call on the world, with the colour that split_world uses (world.cpp).
        PMPI_Comm_split(MPI_COMM_WORLD, 1000 + std::atoi(role), 0, &own_world);
}

}  // namespace

namespace turbidite {

void isolate_world(MPI_Comm local) {
    own_world = local;
}

}  // namespace turbidite

extern "C" {

// For the participant library in the same program, which makes the split where nobody has
// (world.cpp).
MPI_Comm turbidite_world_split_before() {
    return own_world;
}
void turbidite_world_split_now(MPI_Comm local) {
    if (own_world == MPI_COMM_NULL && preloaded_role() != nullptr) own_world = local;
}

int MPI_Init(int* argc, char*** argv) {
    const int status = PMPI_Init(argc, argv);
    split_if_asked();
    return status;
}

int MPI_Init_thread(int* argc, char*** argv, int required, int* provided) {
    const int status = PMPI_Init_thread(argc, argv, required, provided);
    split_if_asked();
    return status;
}

// Here only so that all calls of libPstream are in this list.
int MPI_Finalize() {
    return PMPI_Finalize();
}

int MPI_Abort(MPI_Comm comm, int code) {
    return PMPI_Abort(comm, code);
}

int MPI_Comm_size(MPI_Comm comm, int* size) {
    return PMPI_Comm_size(isolated(comm), size);
}

int MPI_Comm_rank(MPI_Comm comm, int* rank) {
    return PMPI_Comm_rank(isolated(comm), rank);
}

int MPI_Comm_group(MPI_Comm comm, MPI_Group* group) {
    return PMPI_Comm_group(isolated(comm), group);
}

int MPI_Comm_create(MPI_Comm comm, MPI_Group group, MPI_Comm* created) {
    return PMPI_Comm_create(isolated(comm), group, created);
}

int MPI_Allreduce(const void* in, void* out, int count, MPI_Datatype type, MPI_Op op,
                  MPI_Comm comm) {
    return PMPI_Allreduce(in, out, count, type, op, isolated(comm));
}

int MPI_Alltoall(const void* in, int in_count, MPI_Datatype in_type, void* out, int out_count,
                 MPI_Datatype out_type, MPI_Comm comm) {
    return PMPI_Alltoall(in, in_count, in_type, out, out_count, out_type, isolated(comm));
}

int MPI_Alltoallv(const void* in, const int in_counts[], const int in_starts[],
                  MPI_Datatype in_type, void* out, const int out_counts[], const int out_starts[],
                  MPI_Datatype out_type, MPI_Comm comm) {
    return PMPI_Alltoallv(in, in_counts, in_starts, in_type, out, out_counts, out_starts, out_type,
                          isolated(comm));
}

int MPI_Gatherv(const void* in, int in_count, MPI_Datatype in_type, void* out, const int counts[],
                const int starts[], MPI_Datatype out_type, int root, MPI_Comm comm) {
    return PMPI_Gatherv(in, in_count, in_type, out, counts, starts, out_type, root, isolated(comm));
}

int MPI_Scatterv(const void* in, const int counts[], const int starts[], MPI_Datatype in_type,
                 void* out, int out_count, MPI_Datatype out_type, int root, MPI_Comm comm) {
    return PMPI_Scatterv(in, counts, starts, in_type, out, out_count, out_type, root,
                         isolated(comm));
}

int MPI_Send(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm) {
    return PMPI_Send(data, count, type, to, tag, isolated(comm));
}

int MPI_Bsend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm) {
    return PMPI_Bsend(data, count, type, to, tag, isolated(comm));
}

int MPI_Isend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm,
              MPI_Request* request) {
    return PMPI_Isend(data, count, type, to, tag, isolated(comm), request);
}

int MPI_Recv(void* data, int count, MPI_Datatype type, int from, int tag, MPI_Comm comm,
             MPI_Status* status) {
    return PMPI_Recv(data, count, type, from, tag, isolated(comm), status);
}

int MPI_Irecv(void* data, int count, MPI_Datatype type, int from, int tag, MPI_Comm comm,
              MPI_Request* request) {
    return PMPI_Irecv(data, count, type, from, tag, isolated(comm), request);
}

int MPI_Probe(int from, int tag, MPI_Comm comm, MPI_Status* status) {
    return PMPI_Probe(from, tag, isolated(comm), status);
}

}  // extern "C"
