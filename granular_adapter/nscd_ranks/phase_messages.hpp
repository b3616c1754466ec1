// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Phases by persistent messages, between nodes.
#pragma once

#include "granular_adapter/nscd_ranks/phase_transport.hpp"

namespace turbidite::nscd {

class PhaseMessages final : public PhaseTransport {
 public:
    explicit PhaseMessages(MPI_Comm communicator) : communicator_(communicator) {}
    ~PhaseMessages() override;
    PhaseMessages(const PhaseMessages&) = delete;
    PhaseMessages& operator=(const PhaseMessages&) = delete;

    void prepare(const std::vector<Traffic>& phases) override;
    double* outgoing(std::size_t phase, int to) override;
    void post(std::size_t phase) override;
    void await(std::size_t phase) override;
    const double* incoming(std::size_t phase, int from) override;

 private:
    using ByRank = std::vector<std::vector<double>>;
    struct Phase {
        ByRank sent, received;
        std::vector<MPI_Request> requests;
    };

    void release();

    MPI_Comm communicator_;
    std::vector<Phase> phases_;
};

}  // namespace turbidite::nscd
