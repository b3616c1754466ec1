// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Ranks of the contact engine that exchange by MPI: what is repeated within a solve through shared
// memory if they are on one node, by persistent messages otherwise.
//
// All calls are PMPI_* on a duplicate of the communicator, as in fluid_adapter/ranks: the MPI_*
// names belong to a host code.
#pragma once

#include <memory>

#include "granular_adapter/nscd_ranks/phase_transport.hpp"

namespace turbidite::nscd {

class MpiExchange final : public RankExchange {
 public:
    enum class Way { shared_memory_if_possible, messages };

    /// Created and destroyed collectively.
    explicit MpiExchange(MPI_Comm communicator, Way way = Way::shared_memory_if_possible);
    ~MpiExchange() override;
    MpiExchange(const MpiExchange&) = delete;
    MpiExchange& operator=(const MpiExchange&) = delete;

    int rank() const override { return rank_; }
    int size() const override { return size_; }
    std::vector<Bytes> gather(Bytes mine) override;
    std::vector<Bytes> swap(std::vector<Bytes> parts) override;

    void prepare(const std::vector<Traffic>& phases) override { phases_->prepare(phases); }
    double* outgoing(std::size_t phase, int to) override { return phases_->outgoing(phase, to); }
    void post(std::size_t phase) override { phases_->post(phase); }
    void await(std::size_t phase) override { phases_->await(phase); }
    const double* incoming(std::size_t phase, int from) override {
        return phases_->incoming(phase, from);
    }

 private:
    bool on_one_node() const;

    MPI_Comm communicator_ = MPI_COMM_NULL;
    int rank_ = 0, size_ = 1;
    std::unique_ptr<PhaseTransport> phases_;
};

}  // namespace turbidite::nscd
