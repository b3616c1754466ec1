// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bench/coupling/stamped_channel.hpp"

#include <utility>

#include "bench/timing/step_clock.hpp"

namespace turbidite::bench {
namespace {

constexpr std::size_t header_bytes = 6 * sizeof(std::int64_t);

Stamp stamp_of(const Bytes& frame) {
    std::int64_t header[6];
    std::memcpy(header, frame.data(), header_bytes);
    Stamp stamp;
    stamp.kind = static_cast<Kind>(header[1]);
    stamp.window = header[2];
    stamp.bytes = static_cast<std::int64_t>(frame.size());
    stamp.processor = processor_seconds();
    return stamp;
}

}  // namespace

void StampedChannel::send(int peer, Bytes bytes) {
    Stamp stamp = stamp_of(bytes);
    stamp.sent = true;
    stamp.begin = wall_seconds();
    channel_.send(peer, std::move(bytes));
    stamp.end = wall_seconds();
    stamps_.push_back(stamp);
}

std::optional<Channel::Frame> StampedChannel::try_receive() {
    auto frame = channel_.try_receive();
    if (!frame) return frame;
    Stamp stamp = stamp_of(frame->bytes);
    stamp.begin = stamp.end = wall_seconds();
    stamps_.push_back(stamp);
    return frame;
}

}  // namespace turbidite::bench
