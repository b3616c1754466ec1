// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// Sends frames between the coupler and the ranks of one participant. A channel never blocks:
/// sending queues, receiving probes; waiting is done in `Patience` below. Valid C++17.
#pragma once

#include <chrono>
#include <optional>

#include "coupler/protocol/wire.hpp"

namespace turbidite {

/// One end of the connection between the coupler and the ranks of a participant.
class Channel {
 public:
    /// A message as it came, and the rank that sent it.
    struct Frame {
        int peer = 0;
        Bytes bytes;
    };

    virtual ~Channel() = default;

    /// Number of ranks at the other end.
    virtual int peers() const = 0;

    /// Takes the frame and returns at once; frames to one peer arrive in order.
    virtual void send(int peer, Bytes bytes) = 0;

    /// The next frame received from any peer, if there is one.
    virtual std::optional<Frame> try_receive() = 0;

    /// True if every frame has been sent.
    virtual bool flushed() = 0;

    /// True while a long frame moves and needs both ends to attend to it: sleeping would hold it
    /// up. False again when it takes longer than its length explains, since the other end is busy.
    virtual bool in_transit() const { return false; }
};

/// Waiting without continuous polling: polls for 50 us, then sleeps for a 64th of the time waited
/// so far, 20 us to 2 ms, so that a waiting process leaves its core to one that computes and adds
/// little to what it waits for. A ring of the doorbell ends a sleep, and polling begins again. No
/// sleeps while a frame moves.
class Patience {
 public:
    using Clock = std::chrono::steady_clock;

    /// One poll or sleep.
    void wait(bool in_transit = false);

    /// Waited so far, without the time in which this process was stopped: a batch system may
    /// suspend all programs of a job for hours.
    double seconds() const;

 private:
    Clock::time_point last_look_ = Clock::now();
    Clock::time_point last_ring_ = last_look_;
    double waited_ = 0.0;  ///< up to the last look [s]
};

}  // namespace turbidite
