/* SPDX-License-Identifier: LGPL-2.1-or-later
 *
 * other_sizes HOW RUN: examples/falling.c with a turbidite_adapter of another size than the library's, as a
 * program of another version has, or with an MPI of its own. */
#include <mpi.h>
#include <stdio.h>
#define main main_of_falling
#include "falling.c"
#undef main

typedef struct {
    turbidite_adapter known;
    void* member_of_tomorrow;
} adapter_of_tomorrow;

static void joined(void* self, int communicator) {
    int ranks;
    MPI_Comm_size(MPI_Comm_f2c(communicator), &ranks);
    printf("joined with %d of %d ranks\n", ranks, *(int*)self);
    fflush(stdout);
}

static void refuse_ranks(void* self, int communicator) {
    (void)self, (void)communicator;
    turbidite_fail("these ranks will not do", 0);
}

static int run_with_own_mpi(adapter_of_tomorrow* mine, int* argc, char*** argv) {
    int world;
    MPI_Comm split;
    turbidite_before_mpi_init();
    MPI_Init(argc, argv);
    MPI_Comm_size(MPI_COMM_WORLD, &world);
    MPI_Comm_split(MPI_COMM_WORLD, 3, 0, &split);
    mine->known.self = &world;
    mine->known.joined = joined;
    mine->known.communicator = (uintptr_t)split;
    const int code = turbidite_run_grains(&mine->known, argc, argv, (*argv)[*argc - 1]);
    turbidite_before_mpi_finalize();
    MPI_Finalize();
    return code;
}

int main(int argc, char** argv) {
    adapter_of_tomorrow mine = {.known = falling};
    mine.known.dimensions = 0; /* the plane, as of a program that does not know the member */
    size_t size = sizeof mine;
    if (strcmp(argv[1], "own-mpi") == 0) return run_with_own_mpi(&mine, &argc, &argv);
    if (strcmp(argv[1], "uses-more") == 0) mine.member_of_tomorrow = &mine;
    if (strcmp(argv[1], "too-small") == 0) size = 8;
    if (strcmp(argv[1], "both-dimensions") == 0) mine.known.dimensions = TURBIDITE_BOTH_DIMENSIONS;
    if (strcmp(argv[1], "four-dimensions") == 0) mine.known.dimensions = 4;
    if (strcmp(argv[1], "refuses-ranks") == 0) mine.known.joined = refuse_ranks;
    return turbidite_run_grains_sized(&mine.known, size, &argc, &argv, argv[argc - 1]);
}
