// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// The legal order of messages, as data. The order of a window is defined by its scheme
/// (hub/schemes). The coupler sends it to every participant at the start, and both ends check every
/// message against it: a call out of order is an error message, never a deadlock. Nothing here
/// depends on a particular scheme. Valid C++17.
///
/// Between two windows the coupler may also have a checkpoint written or read: save → saved,
/// restore → restored. For all participants, at any time: dismiss → farewell → release, or failure
/// before them.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "coupler/protocol/message.hpp"

namespace turbidite {

/// How often a step occurs in one window.
enum class Times { once, per_round };

/// One message of an order, as one role sends or receives it.
struct Step {
    Kind kind;
    bool from_coupler;  ///< or to the coupler
    Times times = Times::once;
};

/// The messages of a window between the coupler and one rank. Consecutive `per_round` steps form a
/// round, which occurs once or more: after each round only the coupler decides whether another one
/// follows, so a participant must expect one of two kinds. The envelope's `iteration` counts the
/// rounds begun in the window.
using Order = std::vector<Step>;

/// For tables of orders.
inline constexpr bool from_coupler = true;
inline constexpr bool to_coupler = false;

/// Payload of `order`.
Bytes encode(const Order&);
/// Throws MalformedPayload.
template <>
Order decode(View);

/// The messages before the first window.
Order start_order(Role role);

/// Throws std::invalid_argument unless the order begins with the coupler's `window`, which occurs
/// once, contains only messages of a window, and every round begins with and is followed by a
/// message of the coupler.
void check_window_order(const Order& order);

/// A message that is not due, or not the expected one.
class OrderViolation : public std::runtime_error {
 public:
    using std::runtime_error::runtime_error;
};

/// Tracks the messages between the coupler and one rank of a participant. Both ends keep one and
/// pass every message through it.
class CallOrder {
 public:
    CallOrder(Role role, std::string peer_name);

    /// To be called before the start is over. Throws like check_window_order.
    void set_window_order(Order order);

    /// Between two windows, for a run that goes on: so many windows were done before.
    void go_on_after(std::int64_t windows) { window_ = windows - 1; }

    /// The name of the other end in error messages, once more is known of it.
    void set_peer_name(std::string name) { peer_ = std::move(name); }

    /// The envelope for the next message of this kind; throws OrderViolation when it is not due.
    Envelope next_sent(Kind kind, bool by_coupler);

    /// Throws OrderViolation unless the envelope is the expected one in kind, window, iteration and
    /// sequence.
    void received(const Envelope& envelope, bool by_coupler);

    /// The messages that may come next: one, or several from the same sender after a round, whose
    /// first one ends the rounds, and between windows, whose first one is `window`.
    std::vector<Step> due() const;
    /// Whether this one may come next.
    bool is_due(Kind kind, bool by_coupler) const;

    /// "\"motion\"", or after a round "\"accept\" or \"constraint\"".
    std::string due_text() const;

    /// True until the last message of the present window has passed.
    bool inside_window() const { return started_ && at_ > 0; }

    std::int64_t window() const { return window_; }        ///< the present one; -1 before the first
    std::int64_t iteration() const { return iteration_; }  ///< rounds begun in this window

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
    std::optional<Kind> answer_due_;  ///< to `save` or `restore`
    bool dismissed_ = false;
    bool said_farewell_ = false;
    std::int64_t window_ = -1;
    std::int64_t iteration_ = 0;
    std::int64_t from_coupler_ = 0;
    std::int64_t to_coupler_ = 0;
};

}  // namespace turbidite
