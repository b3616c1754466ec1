// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A channel that notes when frames pass.
#pragma once

#include "bench/coupling/stamps.hpp"
#include "coupler/transport/channel.hpp"

namespace turbidite::bench {

class StampedChannel final : public Channel {
 public:
    /// Appends to `stamps`, which several channels may share.
    StampedChannel(Channel& channel, std::vector<Stamp>& stamps)
        : channel_(channel), stamps_(stamps) {}

    int peers() const override { return channel_.peers(); }
    void send(int peer, Bytes bytes) override;
    std::optional<Frame> try_receive() override;
    bool flushed() override { return channel_.flushed(); }
    bool in_transit() const override { return channel_.in_transit(); }

 private:
    Channel& channel_;
    std::vector<Stamp>& stamps_;
};

}  // namespace turbidite::bench
