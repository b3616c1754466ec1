// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Calls are PMPI_*: inside a program with world isolation the MPI_* names belong to the host code.
#include "coupler/transport/intercomm_channel.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "coupler/transport/world.hpp"

namespace turbidite {
namespace {

constexpr int frame_tag = 7;

// MPI moves a long frame in small pieces, and each end only while it is inside MPI: where both ends
// slept after every few pieces, the rate was 0.2 GB/s (docs/decisions/messages.md). A sender
// attends to its frame for the time that it takes at `slow_sending` and a little more, in which the
// receiver may wake up; after that the receiver must be busy. One who receives knows that the
// sender is there, unless it has died in between.
constexpr double slow_sending = 0.5e9;         // [bytes/s]
constexpr double slow_receiving = 20e6;        // [bytes/s]
constexpr double shortest_attention = 500e-6;  // [s]

std::chrono::steady_clock::time_point attended_until(std::size_t bytes, double rate) {
    using Clock = std::chrono::steady_clock;
    const double seconds = shortest_attention + static_cast<double>(bytes) / rate;
    return Clock::now() +
           std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

}  // namespace

IntercommChannel::IntercommChannel(MPI_Comm intercomm) : intercomm_(intercomm) {
    PMPI_Comm_remote_size(intercomm_, &peers_);
    for (const int rank : world_ranks_of_peers(intercomm_)) bells_.emplace_back(bell_name(rank));
}

void IntercommChannel::send(int peer, Bytes bytes) {
    // MPI counts in int: 2 GB, some eight million grains.
    if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
        throw std::length_error("a frame of " + std::to_string(bytes.size()) +
                                " bytes is more than MPI sends at once; use more ranks");
    flushed();  // discard completed sends
    Pending& frame = pending_.emplace_back();
    frame.bytes = std::move(bytes);
    frame.attended_until = attended_until(frame.bytes.size(), slow_sending);
    // The list keeps the bytes in place until MPI has read them (flushed()).
    PMPI_Isend(frame.bytes.data(), static_cast<int>(frame.bytes.size()), MPI_BYTE, peer, frame_tag,
               intercomm_, &frame.request);
    // After MPI has the frame: whoever wakes up must find it.
    bells_[static_cast<std::size_t>(peer)].ring();
}

std::optional<Channel::Frame> IntercommChannel::try_receive() {
    begin_receiving();
    std::vector<int> blocked;  // peers with an earlier frame in flight: their frames stay in order
    for (auto at = incoming_.begin(); at != incoming_.end(); ++at) {
        const int peer = at->frame.peer;
        if (std::find(blocked.begin(), blocked.end(), peer) != blocked.end()) continue;
        if (is_complete(*at)) {
            Frame frame = std::move(at->frame);
            incoming_.erase(at);
            return frame;
        }
        blocked.push_back(peer);
    }
    flushed();  // progresses long frames
    return std::nullopt;
}

// A blocking receive of a long frame would wait for its sender, which may be stopped or dead. The
// receive is therefore non-blocking, and the caller enforces its own time limit.
void IntercommChannel::begin_receiving() {
    for (;;) {
        int arrived = 0;
        MPI_Message message = MPI_MESSAGE_NULL;
        MPI_Status status;
        // A matched probe: the frame that was measured is the one that is received.
        PMPI_Improbe(MPI_ANY_SOURCE, frame_tag, intercomm_, &arrived, &message, &status);
        if (!arrived) return;
        int size = 0;
        PMPI_Get_count(&status, MPI_BYTE, &size);
        Incoming& incoming = incoming_.emplace_back();
        incoming.frame = {status.MPI_SOURCE, Bytes(static_cast<std::size_t>(size))};
        incoming.attended_until = attended_until(incoming.frame.bytes.size(), slow_receiving);
        PMPI_Imrecv(incoming.frame.bytes.data(), size, MPI_BYTE, &message, &incoming.request);
    }
}

bool IntercommChannel::is_complete(Incoming& incoming) {
    int complete = 0;
    PMPI_Test(&incoming.request, &complete, MPI_STATUS_IGNORE);
    return complete != 0;
}

bool IntercommChannel::flushed() {
    for (auto frame = pending_.begin(); frame != pending_.end();) {
        int done = 0;
        PMPI_Test(&frame->request, &done, MPI_STATUS_IGNORE);
        frame = done ? pending_.erase(frame) : std::next(frame);
    }
    return pending_.empty();
}

bool IntercommChannel::in_transit() const {
    if (pending_.empty() && incoming_.empty()) return false;
    const auto moves = [now = Clock::now()](const auto& frame) {
        return now < frame.attended_until;
    };
    return std::any_of(incoming_.begin(), incoming_.end(), moves) ||
           std::any_of(pending_.begin(), pending_.end(), moves);
}

}  // namespace turbidite
