// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/protocol/call_order.hpp"

#include <utility>

namespace turbidite {
namespace {

struct SchemeOrder {
    const char* scheme;
    Role role;
    Order order;
};

constexpr bool from_coupler = true;
constexpr bool to_coupler = false;

const std::vector<SchemeOrder> windows = {
    {"split",
     Role::fluid,
     {{Kind::window, from_coupler}, {Kind::constraint, from_coupler}, {Kind::kicks, to_coupler}}},
    {"split",
     Role::grains,
     {{Kind::window, from_coupler},
      {Kind::motion, to_coupler},
      {Kind::kick, from_coupler},
      {Kind::state, to_coupler}}},
    {"joint",
     Role::fluid,
     {{Kind::window, from_coupler},
      {Kind::bodies, from_coupler},
      {Kind::response, to_coupler},
      {Kind::constraint, from_coupler},
      {Kind::kicks, to_coupler}}},
    {"joint",
     Role::grains,
     {{Kind::window, from_coupler},
      {Kind::contact_input, from_coupler},
      {Kind::motion, to_coupler},
      {Kind::kick, from_coupler},
      {Kind::state, to_coupler}}},
    {"dry",
     Role::grains,
     {{Kind::window, from_coupler}, {Kind::kick, from_coupler}, {Kind::state, to_coupler}}},
};

std::string step_text(Kind kind, bool sent_by_coupler) {
    return "\"" + kind_name(kind) + "\" from the " + (sent_by_coupler ? "coupler" : "participant");
}

}  // namespace

Order start_order(Role role) {
    if (role == Role::fluid)
        return {{Kind::hello, to_coupler},
                {Kind::settings, from_coupler},
                {Kind::shapes, from_coupler},
                {Kind::domain, to_coupler}};
    return {{Kind::hello, to_coupler},
            {Kind::settings, from_coupler},
            {Kind::shapes, from_coupler},
            {Kind::population, from_coupler},
            {Kind::state, to_coupler}};
}

Order window_order(Role role, const std::string& scheme) {
    for (const SchemeOrder& entry : windows)
        if (entry.role == role && scheme == entry.scheme) return entry.order;
    throw std::invalid_argument("no order of messages for the " + std::string(role_name(role)) +
                                " in scheme \"" + scheme + "\"");
}

CallOrder::CallOrder(Role role, std::string peer_name)
    : role_(role), peer_(std::move(peer_name)), order_(start_order(role)) {}

void CallOrder::set_scheme(const std::string& scheme) {
    window_order(role_, scheme);  // throws for an unknown one
    scheme_ = scheme;
}

Kind CallOrder::due() const {
    return due_step().kind;
}
bool CallOrder::due_from_coupler() const {
    return due_step().from_coupler;
}

const Step& CallOrder::due_step() const {
    static const Order end = {{Kind::farewell, to_coupler}, {Kind::release, from_coupler}};
    return dismissed_ ? end[said_farewell_ ? 1 : 0] : order_[at_];
}

// Bad news may come at any time; nothing follows a dismissal but the farewell.
bool CallOrder::may_interrupt(Kind kind, bool sent_by_coupler) const {
    if (kind == Kind::dismiss) return sent_by_coupler && !dismissed_;
    return kind == Kind::failure && !sent_by_coupler;
}

void CallOrder::demand(Kind kind, bool sent_by_coupler, const char* verb) const {
    const Step& step = due_step();
    if (may_interrupt(kind, sent_by_coupler)) return;
    if (step.kind == kind && step.from_coupler == sent_by_coupler) return;
    throw OrderViolation(peer_ + ": " + verb + " " + step_text(kind, sent_by_coupler) +
                         " in window " + std::to_string(window_) + ", but " +
                         step_text(step.kind, step.from_coupler) + " is due");
}

void CallOrder::advance(Kind kind) {
    if (kind == Kind::dismiss) dismissed_ = true;
    if (kind == Kind::farewell) said_farewell_ = true;
    if (dismissed_ || kind == Kind::failure) return;
    if (kind == Kind::window) ++window_;
    if (++at_ < order_.size()) return;
    if (!started_) {
        if (scheme_.empty())
            throw OrderViolation(peer_ + ": the start is over but no scheme was agreed");
        order_ = window_order(role_, scheme_);
        started_ = true;
    }
    at_ = 0;
}

Envelope CallOrder::next_sent(Kind kind, bool sent_by_coupler) {
    demand(kind, sent_by_coupler, "about to send");
    Envelope envelope;
    envelope.kind = kind;
    envelope.window = kind == Kind::window ? window_ + 1 : window_;
    envelope.sequence = counter(sent_by_coupler)++;
    advance(kind);
    return envelope;
}

void CallOrder::received(const Envelope& envelope, bool sent_by_coupler) {
    demand(envelope.kind, sent_by_coupler, "received");
    const std::int64_t window = envelope.kind == Kind::window ? window_ + 1 : window_;
    const std::int64_t sequence = counter(sent_by_coupler)++;
    const bool interrupts = may_interrupt(envelope.kind, sent_by_coupler);
    // Bad news and last words are heard even after a message was lost.
    if (interrupts || dismissed_) return advance(envelope.kind);
    if (envelope.window != window || envelope.sequence != sequence)
        throw OrderViolation(peer_ + ": received " + step_text(envelope.kind, sent_by_coupler) +
                             " number " + std::to_string(envelope.sequence) + " of window " +
                             std::to_string(envelope.window) + ", expected number " +
                             std::to_string(sequence) + " of window " + std::to_string(window));
    if (envelope.iteration != 0)
        throw OrderViolation(peer_ + ": received " + step_text(envelope.kind, sent_by_coupler) +
                             " of iteration " + std::to_string(envelope.iteration) +
                             ", but the scheme does not iterate");
    advance(envelope.kind);
}

}  // namespace turbidite
