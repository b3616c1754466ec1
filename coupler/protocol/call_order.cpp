// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/protocol/call_order.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace turbidite {
namespace {

constexpr Kind window_kinds[] = {
    Kind::window, Kind::bodies, Kind::response, Kind::contact_input, Kind::motion,
    Kind::accept, Kind::kicks,  Kind::kick,     Kind::constraint,    Kind::state};

/// What the coupler may ask for between two windows, and the answers.
constexpr std::pair<Kind, Kind> between_windows[] = {{Kind::save, Kind::saved},
                                                     {Kind::restore, Kind::restored}};

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

Bytes encode(const Order& order) {
    Bytes out;
    Writer code(out);
    code(static_cast<std::int64_t>(order.size()));
    for (const Step& step : order)
        code(static_cast<std::int32_t>(step.kind)), code(step.from_coupler),
            code(step.times == Times::per_round);
    return out;
}

template <>
Order decode(View in) {
    Reader code(in);
    Order order(code.length());
    for (Step& step : order) {
        std::int32_t kind = 0;
        bool repeated = false;
        code(kind), code(step.from_coupler), code(repeated);
        step.kind = static_cast<Kind>(kind);
        step.times = repeated ? Times::per_round : Times::once;
    }
    code.finish();
    return order;
}

Order start_order(Role role) {
    Order order = {{Kind::hello, to_coupler},
                   {Kind::settings, from_coupler},
                   {Kind::order, from_coupler},
                   {Kind::shapes, from_coupler}};
    // The fluid knows its box only when it has read its case; grains are given theirs and answer
    // with the state of t = 0.
    if (role == Role::fluid) {
        order.push_back({Kind::domain, to_coupler});
    } else {
        order.push_back({Kind::population, from_coupler});
        order.push_back({Kind::state, to_coupler});
    }
    return order;
}

void check_window_order(const Order& order) {
    const auto refuse = [](const std::string& why) {
        throw std::invalid_argument("the order of a window " + why);
    };
    // The first message of a window opens it, and advance() counts windows by it.
    if (order.empty() || order.front().kind != Kind::window || !order.front().from_coupler ||
        order.front().times != Times::once)
        refuse("does not begin with \"window\" from the coupler");
    for (std::size_t i = 0; i < order.size(); ++i) {
        const Step& step = order[i];
        if (std::find(std::begin(window_kinds), std::end(window_kinds), step.kind) ==
            std::end(window_kinds))
            refuse("holds \"" + kind_name(step.kind) + "\", which is not a message of a window");
        if (i > 0 && step.kind == Kind::window) refuse("holds \"window\" twice");
        // Where rounds begin or end the coupler speaks: a participant whose turn it were would not
        // know whether to begin another round.
        const bool border = i > 0 && step.times != order[i - 1].times;
        if (border && !step.from_coupler)
            refuse("lets \"" + kind_name(step.kind) +
                   "\" of the participant follow where only the coupler decides on another round");
    }
    // Nothing would tell the participant that the last round is over.
    if (order.back().times == Times::per_round) refuse("ends with a round");
}

CallOrder::CallOrder(Role role, std::string peer_name)
    : peer_(std::move(peer_name)), order_(start_order(role)) {}

void CallOrder::set_window_order(Order order) {
    check_window_order(order);
    window_order_ = std::move(order);
}

bool CallOrder::begins_round(std::size_t place) const {
    // The first of the consecutive `per_round` steps.
    return order_[place].times == Times::per_round &&
           (place == 0 || order_[place - 1].times == Times::once);
}

// After a round, either its first step or the step that follows it is due.
std::vector<std::size_t> CallOrder::due_places() const {
    const bool behind_round =
        at_ > 0 && order_[at_].times == Times::once && order_[at_ - 1].times == Times::per_round;
    if (!behind_round) return {at_};
    std::size_t start = at_ - 1;
    while (!begins_round(start)) --start;
    return {at_, start};
}

std::vector<Step> CallOrder::due() const {
    // An end overrides whatever the window was waiting for.
    if (said_farewell_) return {{Kind::release, from_coupler}};
    if (dismissed_) return {{Kind::farewell, to_coupler}};
    if (answer_due_) return {{*answer_due_, to_coupler}};
    std::vector<Step> steps;
    for (const std::size_t place : due_places()) steps.push_back(order_[place]);
    // Between two windows, or before the first one.
    if (started_ && at_ == 0)
        for (const auto& [asked, answer] : between_windows) steps.push_back({asked, from_coupler});
    return steps;
}

bool CallOrder::is_due(Kind kind, bool sent_by_coupler) const {
    const std::vector<Step> steps = due();
    return std::any_of(steps.begin(), steps.end(), [&](const Step& step) {
        return step.kind == kind && step.from_coupler == sent_by_coupler;
    });
}

std::string CallOrder::due_text() const {
    std::string text;
    const bool between = started_ && at_ == 0 && !answer_due_ && !dismissed_;
    // save and restore are possible there as well, but nobody waits for them: only `window` is
    // named.
    for (const Step& step : between ? std::vector<Step>{order_.front()} : due())
        text += (text.empty() ? "\"" : " or \"") + kind_name(step.kind) + "\"";
    return text;
}

// A failure or dismissal may come at any time; after a dismissal only the farewell follows.
bool CallOrder::may_interrupt(Kind kind, bool sent_by_coupler) const {
    if (kind == Kind::dismiss) return sent_by_coupler && !dismissed_;
    return kind == Kind::failure && !sent_by_coupler;
}

void CallOrder::demand(Kind kind, bool sent_by_coupler, const char* verb) const {
    if (may_interrupt(kind, sent_by_coupler)) return;
    if (is_due(kind, sent_by_coupler)) return;
    throw OrderViolation(peer_ + ": " + verb + " " + message_text(kind, sent_by_coupler) + " in " +
                         place_text(window_, iteration_) + ", but " + due_text() +
                         sender_text(due().front().from_coupler) + " is due");
}

// The message was due: advance past it.
void CallOrder::advance(Kind kind) {
    if (kind == Kind::dismiss) dismissed_ = true;
    if (kind == Kind::farewell) said_farewell_ = true;
    // After a dismissal the place in the order means nothing. A failure does not move it either.
    if (dismissed_ || kind == Kind::failure) return;
    for (const auto& [asked, answer] : between_windows) {
        if (kind == asked) answer_due_ = answer;
        if (kind == answer) answer_due_.reset();
        if (kind == asked || kind == answer) return;
    }
    for (const std::size_t place : due_places())
        // After a round: on to the step behind it, or back to its first one.
        if (order_[place].kind == kind) at_ = place;
    if (kind == Kind::window) ++window_, iteration_ = 0;
    // Before at_ moves on, so that the first message of a round already has its number.
    if (begins_round(at_)) ++iteration_;
    if (++at_ == order_.size()) begin_window_order();
}

void CallOrder::begin_window_order() {
    at_ = 0;
    // The last message of a window leads to the first of the next one.
    if (started_) return;
    if (window_order_.empty())
        throw OrderViolation(peer_ + ": the start is over, but the order of a window is not known");
    order_ = window_order_;
    started_ = true;
}

Envelope CallOrder::next_sent(Kind kind, bool sent_by_coupler) {
    // The same test as at the other end: a wrong call is found before it leaves.
    demand(kind, sent_by_coupler, "about to send");
    advance(kind);
    return {kind, window_, iteration_, counter(sent_by_coupler)++};
}

void CallOrder::received(const Envelope& envelope, bool sent_by_coupler) {
    demand(envelope.kind, sent_by_coupler, "received");
    // Failure, dismissal and farewell are accepted even after a message was lost.
    const bool heard = may_interrupt(envelope.kind, sent_by_coupler) || dismissed_;
    advance(envelope.kind);
    // advance() first: the envelope has the window and the round in which the message counts.
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
