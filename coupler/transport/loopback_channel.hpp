// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A channel inside one process, for tests: two ends, hooks to drop, change or hold frames. Both
// ends may be used from different threads.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "coupler/transport/channel.hpp"

namespace turbidite {

class LoopbackChannel final : public Channel {
 public:
    /// A hook may change a frame in transit, or return false to drop it.
    using Hook = std::function<bool(Bytes&)>;

    /// The coupler's end (with `ranks` peers) and one end per rank (with one peer each).
    static std::pair<std::unique_ptr<LoopbackChannel>,
                     std::vector<std::unique_ptr<LoopbackChannel>>>
    connect(int ranks);

    int peers() const override { return peers_; }
    void send(int peer, Bytes bytes) override;
    std::optional<Frame> try_receive() override;
    bool flushed() override { return true; }

    void set_hook(Hook hook) { hook_ = std::move(hook); }

 private:
    struct Wires {
        std::mutex mutex;
        std::deque<Frame> to_coupler;
        std::vector<std::deque<Frame>> to_rank;
    };

    LoopbackChannel(std::shared_ptr<Wires> wires, int rank, int peers)
        : wires_(std::move(wires)), rank_(rank), peers_(peers) {}

    std::shared_ptr<Wires> wires_;
    int rank_;  // -1: the coupler's end
    int peers_;
    Hook hook_;
};

}  // namespace turbidite
