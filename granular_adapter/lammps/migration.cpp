// SPDX-License-Identifier: GPL-2.0-or-later
#include "granular_adapter/lammps/migration.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <tuple>

namespace turbidite::lammps {
namespace {

/// How much goes to each rank and where it begins, in the units of one exchange.
struct Parts {
    explicit Parts(std::vector<int> sizes) : count(std::move(sizes)), first(count.size(), 0) {
        std::partial_sum(count.begin(), count.end() - 1, first.begin() + 1);
    }
    int total() const { return first.back() + count.back(); }

    std::vector<int> count, first;
};

Parts counted_back(const Parts& sent, MPI_Comm communicator) {
    std::vector<int> received(sent.count.size());
    MPI_Alltoall(sent.count.data(), 1, MPI_INT, received.data(), 1, MPI_INT, communicator);
    return Parts(std::move(received));
}

}  // namespace

std::vector<Origin> new_order(std::vector<Origin> found, int rank) {
    const auto key = [rank](const Origin& o) {
        // The own ones first.
        return std::make_tuple(o.rank != rank, o.rank, o.place);
    };
    std::sort(found.begin(), found.end(),
              [&](const Origin& a, const Origin& b) { return key(a) < key(b); });
    return found;
}

std::vector<char> fetch_rows(const std::vector<Origin>& order, const std::vector<char>& rows,
                             std::size_t row_size, MPI_Comm communicator) {
    int ranks = 1;
    MPI_Comm_size(communicator, &ranks);
    std::vector<std::vector<int>> wanted(static_cast<std::size_t>(ranks));
    for (const Origin& origin : order) wanted[std::size_t(origin.rank)].push_back(origin.place);
    std::vector<int> asked, sizes;
    for (const std::vector<int>& places : wanted) {
        asked.insert(asked.end(), places.begin(), places.end());
        sizes.push_back(int(places.size()));
    }
    // First the places are sent to the ranks that have the rows, then the rows come back.
    const Parts ask(sizes), give = counted_back(ask, communicator);
    std::vector<int> places(std::size_t(give.total()));
    MPI_Alltoallv(asked.data(), ask.count.data(), ask.first.data(), MPI_INT, places.data(),
                  give.count.data(), give.first.data(), MPI_INT, communicator);
    std::vector<char> given(places.size() * row_size), got(asked.size() * row_size);
    for (std::size_t i = 0; i < places.size(); ++i)
        std::memcpy(&given[i * row_size], &rows[std::size_t(places[i]) * row_size], row_size);
    MPI_Datatype row;
    // Counted in rows, so that counts and offsets stay far below the limit of an int.
    MPI_Type_contiguous(int(row_size), MPI_BYTE, &row);
    MPI_Type_commit(&row);
    MPI_Alltoallv(given.data(), give.count.data(), give.first.data(), row, got.data(),
                  ask.count.data(), ask.first.data(), row, communicator);
    MPI_Type_free(&row);
    // `got` is sorted by rank and then in the sequence of the request.
    std::vector<int> next = ask.first;
    std::vector<char> result(order.size() * row_size);
    for (std::size_t i = 0; i < order.size(); ++i) {
        const auto at = std::size_t(next[std::size_t(order[i].rank)]++);
        std::memcpy(&result[i * row_size], &got[at * row_size], row_size);
    }
    return result;
}

std::vector<std::int64_t> gather_all(const std::vector<std::int64_t>& mine, MPI_Comm communicator) {
    int ranks = 1, count = int(mine.size());
    MPI_Comm_size(communicator, &ranks);
    std::vector<int> sizes(static_cast<std::size_t>(ranks));
    MPI_Allgather(&count, 1, MPI_INT, sizes.data(), 1, MPI_INT, communicator);
    const Parts parts(sizes);
    std::vector<std::int64_t> all(std::size_t(parts.total()));
    MPI_Allgatherv(mine.data(), count, MPI_INT64_T, all.data(), parts.count.data(),
                   parts.first.data(), MPI_INT64_T, communicator);
    return all;
}

}  // namespace turbidite::lammps
