// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A channel over an MPI intercommunicator between the coupler and a participant.
#pragma once

#include <mpi.h>

#include <list>
#include <vector>

#include "coupler/transport/channel.hpp"
#include "coupler/transport/doorbell.hpp"

namespace turbidite {

class IntercommChannel final : public Channel {
 public:
    /// Does not own the communicator.
    explicit IntercommChannel(MPI_Comm intercomm);

    int peers() const override { return peers_; }
    void send(int peer, Bytes bytes) override;
    std::optional<Frame> try_receive() override;
    bool flushed() override;
    bool in_transit() const override;

 private:
    using Clock = std::chrono::steady_clock;

    struct Pending {
        Bytes bytes;
        Clock::time_point attended_until;
        MPI_Request request = MPI_REQUEST_NULL;
    };
    struct Incoming {
        Frame frame;
        Clock::time_point attended_until;
        MPI_Request request = MPI_REQUEST_NULL;
    };
    void begin_receiving();
    static bool is_complete(Incoming& incoming);

    MPI_Comm intercomm_;
    int peers_ = 0;
    std::vector<BellButton> bells_;  // of the peers
    std::list<Pending> pending_;     // frames that MPI still reads from
    std::list<Incoming>
        incoming_;  // frames that MPI still writes to, in the order of their sending
};

}  // namespace turbidite
