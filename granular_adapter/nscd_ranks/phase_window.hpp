// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Phases through memory that the ranks of a node share. Every rank writes what it sends into its
// own part and counts its phases there; the others read it when the count is theirs. A rank waits
// for all with whom it exchanges anything in any phase, so that nobody is a whole phase ahead and
// overwrites what has not been read.
#pragma once

#include <cstdint>

#include "granular_adapter/nscd_ranks/phase_transport.hpp"

namespace turbidite::nscd {

class PhaseWindow final : public PhaseTransport {
 public:
    /// The ranks must be on one node. Created and destroyed collectively.
    explicit PhaseWindow(MPI_Comm communicator);
    ~PhaseWindow() override;
    PhaseWindow(const PhaseWindow&) = delete;
    PhaseWindow& operator=(const PhaseWindow&) = delete;

    void prepare(const std::vector<Traffic>& phases) override;
    double* outgoing(std::size_t phase, int to) override;
    void post(std::size_t phase) override;
    void await(std::size_t phase) override;
    const double* incoming(std::size_t phase, int from) override;

 private:
    void allocate(std::size_t doubles);
    void release();
    std::size_t place(std::size_t phase, int rank) const {
        return phase * static_cast<std::size_t>(ranks_) + static_cast<std::size_t>(rank);
    }

    MPI_Comm communicator_;
    int exceptions_;  ///< on their way when it was made
    int rank_ = 0, ranks_ = 1;
    MPI_Win window_ = MPI_WIN_NULL;
    std::size_t capacity_ = 0;              ///< doubles of each rank
    std::vector<double*> parts_;            ///< by rank; the first line of the cache is its count
    std::vector<std::size_t> sent_at_;      ///< by phase and receiver, in the own part
    std::vector<std::size_t> received_at_;  ///< by phase and sender, in their parts
    std::vector<int> partners_;
    std::uint64_t count_ = 0;  ///< of posted phases
};

}  // namespace turbidite::nscd
