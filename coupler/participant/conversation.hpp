// SPDX-License-Identifier: LGPL-2.1-or-later
//
// One rank's talk with the coupler: frames, call order, waiting. Adapters see sessions, not this.
#pragma once

#include <map>
#include <utility>

#include "coupler/protocol/call_order.hpp"
#include "coupler/protocol/failure.hpp"
#include "coupler/transport/channel.hpp"

namespace turbidite {

/// Thrown by `receive` when the coupler ends the run instead of going on.
struct Dismissed {
    Verdict verdict;
};

/// The coupler has not spoken for longer than the limit: it is stopped or gone, and nobody is left
/// to report to.
class CouplerSilent : public Failure {
 public:
    explicit CouplerSilent(const std::string& what) : Failure(ExitCode::stalled, what) {}
};

class Conversation {
 public:
    Conversation(Role role, Channel& channel);

    /// Which messages make a window; before the start is over.
    void set_window_order(Order order) { order_.set_window_order(std::move(order)); }

    /// Has the present window's last message not passed yet?
    bool inside_window() const { return order_.inside_window(); }

    /// Is it this side's turn to send this kind?
    bool due_from_here(Kind kind) const { return order_.is_due(kind, to_coupler); }

    /// Longest wait for the coupler [s] before waiting gives up with CouplerSilent.
    void set_limit(double seconds) { limit_ = seconds; }

    void send(Kind kind, Bytes payload);

    /// Waits for the message that is due; after a round the coupler decides which of two it is.
    /// Throws Dismissed, OrderViolation, MalformedPayload, CouplerSilent.
    Message receive();

    /// The same where only this kind can come.
    Bytes receive(Kind kind);

    /// Tells the coupler that this side cannot go on, and waits for its verdict on the run.
    Verdict fail(const Verdict& verdict);

    /// The last word: everything is written. Returns when the coupler has heard it from everybody,
    /// so that nobody is inside MPI_Finalize while somebody else still has to be waited for, or
    /// ended.
    void say_farewell();

 private:
    Message next();

    Channel& channel_;
    CallOrder order_;
    double limit_ = 600.0;
    /// Seconds, as it was the last time, by kind and round.
    std::map<std::pair<Kind, std::int64_t>, double> usual_wait_;
};

}  // namespace turbidite
