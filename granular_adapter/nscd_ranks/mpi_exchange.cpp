// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd_ranks/mpi_exchange.hpp"

#include <limits>
#include <numeric>
#include <stdexcept>

#include "granular_adapter/nscd_ranks/phase_messages.hpp"
#include "granular_adapter/nscd_ranks/phase_window.hpp"

namespace turbidite::nscd {
namespace {

/// Parts of an array, one per rank.
struct Parts {
    explicit Parts(std::vector<int> sizes) : count(std::move(sizes)), first(count.size(), 0) {
        const auto all = std::accumulate(count.begin(), count.end(), std::size_t{0});
        // Counts and offsets of MPI are of type int.
        if (all > std::numeric_limits<int>::max())
            throw std::length_error(
                "the grains ranks exchange more than 2 GB at once: use more grains.ranks");
        std::partial_sum(count.begin(), count.end() - 1, first.begin() + 1);
    }
    std::size_t total() const { return static_cast<std::size_t>(first.back() + count.back()); }

    std::vector<RankExchange::Bytes> of(const RankExchange::Bytes& all) const {
        std::vector<RankExchange::Bytes> parts;
        for (std::size_t rank = 0; rank < count.size(); ++rank)
            parts.emplace_back(all.begin() + first[rank], all.begin() + first[rank] + count[rank]);
        return parts;
    }

    std::vector<int> count, first;
};

}  // namespace

MpiExchange::MpiExchange(MPI_Comm communicator, Way way) {
    PMPI_Comm_dup(communicator, &communicator_);
    PMPI_Comm_rank(communicator_, &rank_);
    PMPI_Comm_size(communicator_, &size_);
    // Chosen once for the run, and the same on all ranks.
    if (way == Way::shared_memory_if_possible && on_one_node())
        phases_ = std::make_unique<PhaseWindow>(communicator_);
    else
        phases_ = std::make_unique<PhaseMessages>(communicator_);
}

MpiExchange::~MpiExchange() {
    phases_.reset();
    int finalized = 0;
    PMPI_Finalized(&finalized);
    if (!finalized) PMPI_Comm_free(&communicator_);
}

bool MpiExchange::on_one_node() const {
    MPI_Comm node = MPI_COMM_NULL;
    PMPI_Comm_split_type(communicator_, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &node);
    int together = 0;
    PMPI_Comm_size(node, &together);
    PMPI_Comm_free(&node);
    int least = together;
    // All ranks must choose the same way, so they agree on the smallest number.
    PMPI_Allreduce(&together, &least, 1, MPI_INT, MPI_MIN, communicator_);
    return least == size_;
}

std::vector<RankExchange::Bytes> MpiExchange::gather(Bytes mine) {
    std::vector<int> sizes(static_cast<std::size_t>(size_));
    const int own = static_cast<int>(mine.size());
    PMPI_Allgather(&own, 1, MPI_INT, sizes.data(), 1, MPI_INT, communicator_);
    const Parts parts(std::move(sizes));
    Bytes all(parts.total());
    PMPI_Allgatherv(mine.data(), own, MPI_BYTE, all.data(), parts.count.data(), parts.first.data(),
                    MPI_BYTE, communicator_);
    return parts.of(all);
}

std::vector<RankExchange::Bytes> MpiExchange::swap(std::vector<Bytes> given) {
    std::vector<int> sizes;
    Bytes sent;
    for (const Bytes& part : given) {
        sizes.push_back(static_cast<int>(part.size()));
        sent.insert(sent.end(), part.begin(), part.end());
    }
    // Sizes travel first: no rank knows what others will send.
    std::vector<int> coming(sizes.size());
    PMPI_Alltoall(sizes.data(), 1, MPI_INT, coming.data(), 1, MPI_INT, communicator_);
    const Parts out(std::move(sizes)), in(std::move(coming));
    Bytes received(in.total());
    PMPI_Alltoallv(sent.data(), out.count.data(), out.first.data(), MPI_BYTE, received.data(),
                   in.count.data(), in.first.data(), MPI_BYTE, communicator_);
    return in.of(received);
}

}  // namespace turbidite::nscd
