// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/ranks/rank_group.hpp"

namespace turbidite {
namespace {

/// A group may outlive MPI, since the host's objects are destroyed at the end of the program.
void release(MPI_Comm* comm) {
    int finalized = 0;
    PMPI_Finalized(&finalized);
    if (!finalized) PMPI_Comm_free(comm);
    delete comm;
}

std::vector<int> starts_of(const std::vector<int>& counts) {
    std::vector<int> starts(counts.size(), 0);
    for (std::size_t r = 1; r < counts.size(); ++r) starts[r] = starts[r - 1] + counts[r - 1];
    return starts;
}

template <class Number>
ByRank<Number> exchange_lists(const RankGroup& group, const ByRank<Number>& lists,
                              MPI_Datatype type) {
    // A single rank gets what it sends to itself, without MPI.
    if (!group.parallel()) return lists;
    const int ranks = group.size();
    std::vector<int> sent(ranks), received(ranks);
    std::vector<Number> out;
    for (int r = 0; r < ranks; ++r) {
        sent[r] = static_cast<int>(lists[r].size());
        out.insert(out.end(), lists[r].begin(), lists[r].end());
    }
    // Lengths first, to make room for the lists.
    PMPI_Alltoall(sent.data(), 1, MPI_INT, received.data(), 1, MPI_INT, group.comm());
    const std::vector<int> out_starts = starts_of(sent), in_starts = starts_of(received);
    std::vector<Number> in(in_starts.back() + received.back());
    PMPI_Alltoallv(out.data(), sent.data(), out_starts.data(), type, in.data(), received.data(),
                   in_starts.data(), type, group.comm());
    ByRank<Number> result(ranks);
    for (int r = 0; r < ranks; ++r)
        result[r].assign(in.begin() + in_starts[r], in.begin() + in_starts[r] + received[r]);
    return result;
}

}  // namespace

RankGroup::RankGroup(MPI_Comm comm) : comm_(new MPI_Comm(MPI_COMM_NULL), release) {
    PMPI_Comm_dup(comm, comm_.get());
    PMPI_Comm_rank(*comm_, &rank_);
    PMPI_Comm_size(*comm_, &size_);
    MPI_Comm node = MPI_COMM_NULL;
    // The ranks on this rank's node; all have to be there, on every rank.
    PMPI_Comm_split_type(*comm_, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &node);
    int on_node = 0;
    PMPI_Comm_size(node, &on_node);
    PMPI_Comm_free(&node);
    one_node_ = all(on_node == size_);
}

void RankGroup::sum(double* values, int count) const {
    if (parallel()) PMPI_Allreduce(MPI_IN_PLACE, values, count, MPI_DOUBLE, MPI_SUM, comm());
}

void RankGroup::max(double* values, int count) const {
    if (parallel()) PMPI_Allreduce(MPI_IN_PLACE, values, count, MPI_DOUBLE, MPI_MAX, comm());
}

bool RankGroup::all(bool here) const {
    int value = here;
    if (parallel()) PMPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_INT, MPI_LAND, comm());
    return value != 0;
}

double RankGroup::from(int root, double value) const {
    if (parallel()) PMPI_Bcast(&value, 1, MPI_DOUBLE, root, comm());
    return value;
}

std::vector<int> RankGroup::everywhere(int value) const {
    std::vector<int> values(size(), value);
    if (parallel()) PMPI_Allgather(&value, 1, MPI_INT, values.data(), 1, MPI_INT, comm());
    return values;
}

ByRank<int> all_to_all(const RankGroup& group, const ByRank<int>& lists) {
    return exchange_lists(group, lists, MPI_INT);
}

ByRank<long long> all_to_all(const RankGroup& group, const ByRank<long long>& lists) {
    return exchange_lists(group, lists, MPI_LONG_LONG);
}

std::vector<Span> even_spans(int total, int ranks) {
    std::vector<Span> spans(ranks);
    int first = 0;
    for (int r = 0; r < ranks; ++r) {
        spans[r] = {first, total / ranks + (r < total % ranks)};
        first += spans[r].count;
    }
    return spans;
}

}  // namespace turbidite
