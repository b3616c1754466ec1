// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd_ranks/phase_messages.hpp"

namespace turbidite::nscd {

PhaseMessages::~PhaseMessages() {
    int finalized = 0;
    PMPI_Finalized(&finalized);
    if (!finalized) release();
}

void PhaseMessages::release() {
    for (Phase& phase : phases_)
        for (MPI_Request& request : phase.requests) PMPI_Request_free(&request);
    phases_.clear();
}

void PhaseMessages::prepare(const std::vector<Traffic>& phases) {
    release();
    for (const Traffic& traffic : phases) {
        Phase& phase = phases_.emplace_back();
        // A tag per phase: a rank that is ahead may have sent the next phase already.
        const int tag = static_cast<int>(phases_.size());
        for (const std::size_t count : traffic.sent) phase.sent.emplace_back(count);
        for (const std::size_t count : traffic.received) phase.received.emplace_back(count);
        const auto add = [&](ByRank& buffers, const auto& init) {
            for (std::size_t rank = 0; rank < buffers.size(); ++rank) {
                std::vector<double>& buffer = buffers[rank];
                // Both sides know the sizes, so that neither expects an empty message.
                if (buffer.empty()) continue;
                init(buffer.data(), static_cast<int>(buffer.size()), MPI_DOUBLE,
                     static_cast<int>(rank), tag, communicator_,
                     &phase.requests.emplace_back(MPI_REQUEST_NULL));
            }
        };
        // Receives first: they are started before the sends.
        add(phase.received, PMPI_Recv_init);
        add(phase.sent, PMPI_Send_init);
    }
}

double* PhaseMessages::outgoing(std::size_t phase, int to) {
    return phases_[phase].sent[static_cast<std::size_t>(to)].data();
}

void PhaseMessages::post(std::size_t phase) {
    std::vector<MPI_Request>& requests = phases_[phase].requests;
    if (requests.empty()) return;
    PMPI_Startall(static_cast<int>(requests.size()), requests.data());
}

void PhaseMessages::await(std::size_t phase) {
    std::vector<MPI_Request>& requests = phases_[phase].requests;
    if (requests.empty()) return;
    PMPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
}

const double* PhaseMessages::incoming(std::size_t phase, int from) {
    return phases_[phase].received[static_cast<std::size_t>(from)].data();
}

}  // namespace turbidite::nscd
