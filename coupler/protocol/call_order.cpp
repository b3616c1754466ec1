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
      {Kind::constraint, from_coupler, Times::per_round},
      {Kind::response, to_coupler, Times::per_round},
      {Kind::accept, from_coupler},
      {Kind::kicks, to_coupler}}},
    {"joint",
     Role::grains,
     {{Kind::window, from_coupler},
      {Kind::contact_input, from_coupler, Times::per_round},
      {Kind::motion, to_coupler, Times::per_round},
      {Kind::kick, from_coupler},
      {Kind::state, to_coupler}}},
    {"dry",
     Role::grains,
     {{Kind::window, from_coupler}, {Kind::kick, from_coupler}, {Kind::state, to_coupler}}},
};

std::string sender_text(bool sent_by_coupler) {
    return std::string(" from the ") + (sent_by_coupler ? "coupler" : "participant");
}

std::string message_text(Kind kind, bool sent_by_coupler) {
    return "\"" + kind_name(kind) + "\"" + sender_text(sent_by_coupler);
}

std::string place_text(std::int64_t window, std::int64_t iteration) {
    return "window " + std::to_string(window) +
           (iteration > 0 ? ", round " + std::to_string(iteration) : "");
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

bool CallOrder::begins_round(std::size_t place) const {
    return order_[place].times == Times::per_round &&
           (place == 0 || order_[place - 1].times == Times::once);
}

// Behind a round its first step is due as well as what follows.
std::vector<std::size_t> CallOrder::due_places() const {
    const bool behind_round =
        at_ > 0 && order_[at_].times == Times::once && order_[at_ - 1].times == Times::per_round;
    if (!behind_round) return {at_};
    std::size_t start = at_ - 1;
    while (!begins_round(start)) --start;
    return {at_, start};
}

std::vector<Step> CallOrder::due() const {
    if (said_farewell_) return {{Kind::release, from_coupler}};
    if (dismissed_) return {{Kind::farewell, to_coupler}};
    std::vector<Step> steps;
    for (const std::size_t place : due_places()) steps.push_back(order_[place]);
    return steps;
}

std::string CallOrder::due_text() const {
    std::string text;
    for (const Step& step : due())
        text += (text.empty() ? "\"" : " or \"") + kind_name(step.kind) + "\"";
    return text;
}

// Bad news may come at any time; nothing follows a dismissal but the farewell.
bool CallOrder::may_interrupt(Kind kind, bool sent_by_coupler) const {
    if (kind == Kind::dismiss) return sent_by_coupler && !dismissed_;
    return kind == Kind::failure && !sent_by_coupler;
}

void CallOrder::demand(Kind kind, bool sent_by_coupler, const char* verb) const {
    if (may_interrupt(kind, sent_by_coupler)) return;
    const std::vector<Step> steps = due();
    for (const Step& step : steps)
        if (step.kind == kind && step.from_coupler == sent_by_coupler) return;
    throw OrderViolation(peer_ + ": " + verb + " " + message_text(kind, sent_by_coupler) + " in " +
                         place_text(window_, iteration_) + ", but " + due_text() +
                         sender_text(steps.front().from_coupler) + " is due");
}

// The message has been found due: the conversation moves behind it.
void CallOrder::advance(Kind kind) {
    if (kind == Kind::dismiss) dismissed_ = true;
    if (kind == Kind::farewell) said_farewell_ = true;
    if (dismissed_ || kind == Kind::failure) return;
    for (const std::size_t place : due_places())
        if (order_[place].kind == kind) at_ = place;
    if (kind == Kind::window) ++window_, iteration_ = 0;
    if (begins_round(at_)) ++iteration_;
    if (++at_ == order_.size()) begin_window_order();
}

void CallOrder::begin_window_order() {
    at_ = 0;
    if (started_) return;
    if (scheme_.empty())
        throw OrderViolation(peer_ + ": the start is over but no scheme was agreed");
    order_ = window_order(role_, scheme_);
    started_ = true;
}

Envelope CallOrder::next_sent(Kind kind, bool sent_by_coupler) {
    demand(kind, sent_by_coupler, "about to send");
    advance(kind);
    return {kind, window_, iteration_, counter(sent_by_coupler)++};
}

void CallOrder::received(const Envelope& envelope, bool sent_by_coupler) {
    demand(envelope.kind, sent_by_coupler, "received");
    // Bad news and last words are heard even after a message was lost.
    const bool heard = may_interrupt(envelope.kind, sent_by_coupler) || dismissed_;
    advance(envelope.kind);
    const std::int64_t sequence = counter(sent_by_coupler)++;
    const bool expected = envelope.window == window_ && envelope.iteration == iteration_ &&
                          envelope.sequence == sequence;
    if (heard || expected) return;
    throw OrderViolation(peer_ + ": received " + message_text(envelope.kind, sent_by_coupler) +
                         " number " + std::to_string(envelope.sequence) + " of " +
                         place_text(envelope.window, envelope.iteration) + ", expected number " +
                         std::to_string(sequence) + " of " + place_text(window_, iteration_));
}

}  // namespace turbidite
