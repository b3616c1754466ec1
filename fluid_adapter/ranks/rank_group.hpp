// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The ranks that share one fluid grid. Without a communicator there is one rank and MPI is never
// called, so that programs without MPI can use everything that takes a group.
//
// All calls are PMPI_* on a duplicate of the communicator: the MPI_* names belong to the host code
// (coupler/transport/world_isolation.hpp), and its messages cannot be confused with ours. Valid
// C++17.
#pragma once

#include <mpi.h>

#include <memory>
#include <vector>

namespace turbidite {

class RankGroup {
 public:
    /// A single rank, without MPI.
    RankGroup() = default;

    /// The ranks of `comm`, which is duplicated. Collective.
    explicit RankGroup(MPI_Comm comm);

    int rank() const { return rank_; }
    int size() const { return size_; }
    bool parallel() const { return size_ > 1; }
    /// Whether all ranks can share memory.
    bool one_node() const { return one_node_; }
    MPI_Comm comm() const { return comm_ ? *comm_ : MPI_COMM_NULL; }

    /// Sums over the ranks, in place; bitwise the same on all.
    void sum(double* values, int count) const;

    /// Maximum over the ranks, in place.
    void max(double* values, int count) const;

    /// True if `here` is true on every rank.
    bool all(bool here) const;

    /// Broadcasts `value` from the rank `root`.
    double from(int root, double value) const;

    /// Gathers one number per rank on all ranks, in the order of the ranks.
    std::vector<int> everywhere(int value) const;

 private:
    std::shared_ptr<MPI_Comm> comm_;
    int rank_ = 0;
    int size_ = 1;
    bool one_node_ = true;
};

/// All-to-all exchange of lists of numbers, indexed by rank; returns what the ranks sent to this
/// one. Every rank exchanges with every other: for set-up and once per window (shared_grains.hpp),
/// not within iterations.
template <class Number>
using ByRank = std::vector<std::vector<Number>>;
ByRank<int> all_to_all(const RankGroup& group, const ByRank<int>& lists);
ByRank<long long> all_to_all(const RankGroup& group, const ByRank<long long>& lists);

/// Indices [first, first + count) of a range divided among the ranks.
struct Span {
    int first = 0;
    int count = 0;
};

/// Divides `total` indices into spans of nearly equal length, one per rank, in order; rank 0 has
/// the first.
std::vector<Span> even_spans(int total, int ranks);

}  // namespace turbidite
