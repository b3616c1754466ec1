// SPDX-License-Identifier: GPL-2.0-or-later
//
// LAMMPS moves grains between ranks as they cross the borders of its subdomains. What others keep
// about each grain follows them here: every grain in LAMMPS carries its Origin, and whoever owns it
// now fetches the rows of bytes from there.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <vector>

namespace turbidite::lammps {

/// Where a grain's row was before: the rank, and its place in that rank's order.
struct Origin {
    int rank = 0;
    int place = 0;
    friend bool operator==(const Origin&, const Origin&) = default;
};

/// The grains that stayed, in their order, then those that arrived, by rank and place: independent
/// of the order in which LAMMPS happens to keep them.
std::vector<Origin> new_order(std::vector<Origin> found, int rank);

/// Rows of `row_size` bytes, one per entry of `order`. `rows` holds this rank's rows as they were.
/// Collective.
std::vector<char> fetch_rows(const std::vector<Origin>& order, const std::vector<char>& rows,
                             std::size_t row_size, MPI_Comm communicator);

/// The numbers of all ranks, rank by rank; collective.
std::vector<std::int64_t> gather_all(const std::vector<std::int64_t>& mine, MPI_Comm communicator);

}  // namespace turbidite::lammps
