// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Every rank runs every test; a failing rank reports its number.
#include <gtest/gtest.h>
#include <mpi.h>

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    testing::InitGoogleTest(&argc, argv);
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    testing::ScopedTrace trace("", 0, "rank " + std::to_string(rank));
    const int result = RUN_ALL_TESTS();
    MPI_Finalize();
    return result;
}
