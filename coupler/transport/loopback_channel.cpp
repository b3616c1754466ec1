// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/transport/loopback_channel.hpp"

namespace turbidite {

std::pair<std::unique_ptr<LoopbackChannel>, std::vector<std::unique_ptr<LoopbackChannel>>>
LoopbackChannel::connect(int ranks) {
    auto wires = std::make_shared<Wires>();
    wires->to_rank.resize(ranks);
    std::unique_ptr<LoopbackChannel> hub(new LoopbackChannel(wires, -1, ranks));
    std::vector<std::unique_ptr<LoopbackChannel>> ends;
    for (int rank = 0; rank < ranks; ++rank) ends.emplace_back(new LoopbackChannel(wires, rank, 1));
    return {std::move(hub), std::move(ends)};
}

void LoopbackChannel::send(int peer, Bytes bytes) {
    // A test may change the frame, or have it lost.
    if (hook_ && !hook_(bytes)) return;
    const std::lock_guard lock(wires_->mutex);
    // -1: the coupler's end. A rank knows one peer, the coupler, as 0.
    if (rank_ < 0)
        wires_->to_rank.at(peer).push_back({0, std::move(bytes)});
    else
        wires_->to_coupler.push_back({rank_, std::move(bytes)});
}

std::optional<Channel::Frame> LoopbackChannel::try_receive() {
    const std::lock_guard lock(wires_->mutex);
    auto& queue = rank_ < 0 ? wires_->to_coupler : wires_->to_rank.at(rank_);
    if (queue.empty()) return std::nullopt;
    Frame frame = std::move(queue.front());
    queue.pop_front();
    return frame;
}

}  // namespace turbidite
