// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The legal order of messages, as data. A window's order belongs to the scheme that plays it
// (hub/schemes); the coupler tells it to every participant at the start, and both ends check every
// message against it: an out-of-order call is an error with a sentence, never a deadlock. Nothing
// here knows a scheme by name. Valid C++17.
//
// For everybody, at any time: dismiss → farewell → release, or failure before them.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "coupler/protocol/message.hpp"

namespace turbidite {

/// How often a step is played in one window.
enum class Times { once, per_round };

/// One message of an order, as one role sends or receives it.
struct Step {
    Kind kind;
    bool from_coupler;
    Times times = Times::once;
};

/// The messages of a window between the coupler and one rank. Neighbouring `per_round` steps are
/// one round, which is played once or more: after each the coupler, and nobody else, decides
/// between another round and what follows, so a participant sees which of two kinds comes. The
/// envelope's `iteration` counts the rounds begun in the window.
using Order = std::vector<Step>;

/// For tables of orders.
inline constexpr bool from_coupler = true;
inline constexpr bool to_coupler = false;

Bytes encode(const Order&);
template <>
Order decode(const Bytes&);

/// What is said before the first window.
Order start_order(Role role);

/// Throws std::invalid_argument unless the order begins with the coupler's `window`, which comes
/// once, consists of messages of a window, and every round begins with and is followed by a message
/// of the coupler.
void check_window_order(const Order& order);

class OrderViolation : public std::runtime_error {
 public:
    using std::runtime_error::runtime_error;
};

/// Follows one conversation between the coupler and one rank of a participant. Either end
/// keeps one and passes every message through it.
class CallOrder {
 public:
    CallOrder(Role role, std::string peer_name);

    /// Before the start is over. Throws as check_window_order.
    void set_window_order(Order order);

    /// The envelope for the next message of this kind; throws OrderViolation when it is not due.
    Envelope next_sent(Kind kind, bool by_coupler);

    /// Throws OrderViolation unless the envelope is the one that is due: kind, window, iteration,
    /// sequence.
    void received(const Envelope& envelope, bool by_coupler);

    /// Every message that may come next: one, or after a round two, of the same sender. The first
    /// is the one that goes on.
    std::vector<Step> due() const;
    bool is_due(Kind kind, bool by_coupler) const;

    /// "\"motion\"", or after a round "\"accept\" or \"constraint\"".
    std::string due_text() const;

    /// Has the present window's last message not passed yet?
    bool inside_window() const { return started_ && at_ > 0; }

    std::int64_t window() const { return window_; }
    std::int64_t iteration() const { return iteration_; }

 private:
    std::vector<std::size_t> due_places() const;
    bool begins_round(std::size_t place) const;
    bool may_interrupt(Kind kind, bool by_coupler) const;
    void demand(Kind kind, bool by_coupler, const char* verb) const;
    void advance(Kind kind);
    void begin_window_order();
    std::int64_t& counter(bool by_coupler) { return by_coupler ? from_coupler_ : to_coupler_; }

    std::string peer_;
    Order order_;
    Order window_order_;
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
