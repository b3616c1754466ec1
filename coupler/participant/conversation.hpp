// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// Communication of one rank with the coupler: frames, call order, waiting. Adapters use sessions,
/// not this.
#pragma once

#include <utility>

#include "coupler/protocol/call_order.hpp"
#include "coupler/protocol/failure.hpp"
#include "coupler/protocol/timeline.hpp"
#include "coupler/transport/channel.hpp"

namespace turbidite {

/// Thrown by `receive` when the coupler ends the run.
struct Dismissed {
    Verdict verdict;
};

/// The coupler has been silent for longer than the limit: it is stopped or gone, and there is no
/// one to report to.
class CouplerSilent : public Failure {
 public:
    explicit CouplerSilent(const std::string& what) : Failure(ExitCode::stalled, what) {}
};

/// The messages between this rank and the coupler, each checked against the call order.
class Conversation {
 public:
    /// The channel outlives it.
    Conversation(Role role, Channel& channel);

    /// Sets the messages of a window; to be called before the start is over.
    void set_window_order(Order order) { order_.set_window_order(std::move(order)); }

    /// The run goes on after so many windows.
    void go_on_after(std::int64_t windows) { order_.go_on_after(windows); }

    /// True until the last message of the present window has passed.
    bool inside_window() const { return order_.inside_window(); }

    /// True if this side is to send this kind next.
    bool due_from_here(Kind kind) const { return order_.is_due(kind, to_coupler); }

    /// Notes waits there.
    void set_timeline(Timeline* timeline) { timeline_ = timeline; }

    /// The present window; -1 before the first.
    std::int64_t window() const { return order_.window(); }

    /// Longest wait for the coupler [s]; then CouplerSilent is thrown.
    void set_limit(double seconds) { limit_ = seconds; }

    /// A message without content.
    void send(Kind kind);
    /// Throws OrderViolation if the kind is not due.
    template <class Record>
    void send(Kind kind, const Record& record) {
        channel_.send(0, framed(order_.next_sent(kind, to_coupler), record));
    }

    /// Attends to what was sent until it has gone or the coupler turns out to be busy: what the
    /// host does between windows would hold up a long frame.
    void flush_sent();

    /// Waits for the message that is due; after a round the coupler decides which of two it is.
    /// Throws Dismissed, OrderViolation, MalformedPayload, CouplerSilent.
    FramedMessage receive();

    /// The same where only this kind is possible.
    FramedMessage receive(Kind kind);

    /// Reports to the coupler that this side cannot continue, and waits for its decision on the
    /// run.
    Verdict fail(const Verdict& verdict);

    /// The last message: everything is written. Returns when the coupler has received it from all
    /// ranks, so that no rank is inside MPI_Finalize while another still has to be waited for or
    /// aborted.
    void say_farewell();

 private:
    FramedMessage next();

    Channel& channel_;
    CallOrder order_;
    Timeline* timeline_ = nullptr;
    double limit_ = 600.0;
};

}  // namespace turbidite
