// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The ranks that share one fluid grid. Without a communicator there is one rank and MPI is never
// called, so that programs without MPI can use whatever takes a group.
//
// All calls are PMPI_* on a duplicate of the communicator: the MPI_* names belong to the host code
// (coupler/transport/world_isolation.hpp), and its messages are never met by ours. Valid C++17.
#pragma once

#include <mpi.h>

#include <memory>
#include <vector>

namespace turbidite {

class RankGroup {
 public:
    /// One rank.
    RankGroup() = default;

    /// The ranks of `comm`, which is duplicated: every rank of it makes its group at the same time.
    explicit RankGroup(MPI_Comm comm);

    int rank() const { return rank_; }
    int size() const { return size_; }
    bool parallel() const { return size_ > 1; }
    /// All ranks can share memory.
    bool one_node() const { return one_node_; }
    MPI_Comm comm() const { return comm_ ? *comm_ : MPI_COMM_NULL; }

    /// Sums over the ranks, in place; the same bits everywhere.
    void sum(double* values, int count) const;

    /// Largest value of all ranks, in place.
    void max(double* values, int count) const;

    /// True when it is on every rank.
    bool all(bool here) const;

    /// `value` of the rank `root`, everywhere.
    double from(int root, double value) const;

    /// One number of each rank to all, in the order of the ranks.
    std::vector<int> everywhere(int value) const;

 private:
    std::shared_ptr<MPI_Comm> comm_;
    int rank_ = 0;
    int size_ = 1;
    bool one_node_ = true;
};

/// Lists of numbers for each rank, and what the ranks sent here: index by rank. Every rank talks to
/// every other: for set-up and once per window (shared_grains.hpp), not within iterations.
template <class Number>
using ByRank = std::vector<std::vector<Number>>;
ByRank<int> all_to_all(const RankGroup& group, const ByRank<int>& lists);
ByRank<long long> all_to_all(const RankGroup& group, const ByRank<long long>& lists);

/// Indices [first, first + count) of something that ranks share.
struct Span {
    int first = 0;
    int count = 0;
};

/// `total` indices in spans of nearly equal length, one per rank, in order; rank 0 has the first.
std::vector<Span> even_spans(int total, int ranks);

}  // namespace turbidite
