// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The legal order of messages, as data. One table per scheme says which message follows which, seen
// by one participant; both ends check against the same table, so an out-of-order call is an error
// with a sentence, never a deadlock. Valid C++17.
//
//     split   window → motion ⇒ constraint → kicks ⇒ kick → state
//     joint   window → bodies → response ⇒ contact_input → motion ⇒ constraint → kicks ⇒ kick →
//     state dry     window → kick → state            (no fluid; kick is empty and says "move")
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

/// The scheme's window as seen by one role: the kinds it sends or receives, in order.
struct Step {
    Kind kind;
    bool from_coupler;
};
using Order = std::vector<Step>;

/// `scheme` is "split", "joint" or "dry". Throws std::invalid_argument for another name, or for a
/// fluid in a dry run.
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

    Kind due() const;
    bool due_from_coupler() const;
    std::int64_t window() const { return window_; }

 private:
    const Step& due_step() const;
    bool may_interrupt(Kind kind, bool from_coupler) const;
    void demand(Kind kind, bool from_coupler, const char* verb) const;
    void advance(Kind kind);
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
    std::int64_t from_coupler_ = 0;
    std::int64_t to_coupler_ = 0;
};

}  // namespace turbidite
