// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The legal order of messages, as data. One table per scheme says which message follows which, seen
// by one participant; both ends check against the same table, so an out-of-order call is an error
// with a sentence, never a deadlock. Valid C++17.
//
//     split   window → motion ⇒ constraint → kicks ⇒ kick → state
//     joint   window → bodies → response { ⇒ contact_input → motion ⇒ constraint → response }
//             → accept → kicks ⇒ kick → state
//     dry     window → kick → state            (no fluid; kick is empty and says "move")
//
// What stands in braces is a round. It is played once or more; after each the coupler, and nobody
// else, decides between another round and what follows, so a participant sees which of two kinds
// comes. The envelope's `iteration` counts the rounds begun in the window.
//
// and for everybody, at any time: dismiss → farewell → release, or failure before them.
//
// (→ to or from the coupler, ⇒ through the coupler to the other side.) Under `split` the fluid does
// steps 1-3 between `window` and `constraint` while the grains do step 4 between `window` and
// `motion`.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "coupler/protocol/message.hpp"

namespace turbidite {

/// How often a step is played in one window.
enum class Times { once, per_round };

/// The scheme's window as seen by one role: the kinds it sends or receives, in order. Neighbouring
/// `per_round` steps are one round, which begins with a message of the coupler.
struct Step {
    Kind kind;
    bool from_coupler;
    Times times = Times::once;
};
using Order = std::vector<Step>;

/// `scheme` is "split", "joint" or "dry". window_order throws std::invalid_argument for another
/// name, or for a fluid in a dry run.
Order start_order(Role role);
Order window_order(Role role, const std::string& scheme);

class OrderViolation : public std::runtime_error {
 public:
    using std::runtime_error::runtime_error;
};

/// Follows one conversation between the coupler and one rank of a participant. Either end
/// keeps one and passes every message through it.
class CallOrder {
 public:
    CallOrder(Role role, std::string peer_name);

    /// After the start the scheme is known.
    void set_scheme(const std::string& scheme);

    /// The envelope for the next message of this kind; throws OrderViolation when it is not due.
    Envelope next_sent(Kind kind, bool from_coupler);

    /// Throws OrderViolation unless the envelope is the one that is due: kind, window, iteration,
    /// sequence.
    void received(const Envelope& envelope, bool from_coupler);

    /// Every message that may come next: one, or after a round two, of the same sender. The first
    /// is the one that goes on.
    std::vector<Step> due() const;

    /// "\"motion\"", or after a round "\"accept\" or \"constraint\"".
    std::string due_text() const;

    std::int64_t window() const { return window_; }
    std::int64_t iteration() const { return iteration_; }

 private:
    std::vector<std::size_t> due_places() const;
    bool begins_round(std::size_t place) const;
    bool may_interrupt(Kind kind, bool from_coupler) const;
    void demand(Kind kind, bool from_coupler, const char* verb) const;
    void advance(Kind kind);
    void begin_window_order();
    std::int64_t& counter(bool from_coupler) { return from_coupler ? from_coupler_ : to_coupler_; }

    Role role_;
    std::string peer_;
    Order order_;
    std::string scheme_;
    std::size_t at_ = 0;
    bool started_ = false;
    bool dismissed_ = false;
    bool said_farewell_ = false;
    std::int64_t window_ = -1;
    std::int64_t iteration_ = 0;
    std::int64_t from_coupler_ = 0;
    std::int64_t to_coupler_ = 0;
};

}  // namespace turbidite
