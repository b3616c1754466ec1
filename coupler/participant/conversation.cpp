// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/participant/conversation.hpp"

#include <utility>

namespace turbidite {

Conversation::Conversation(Role role, Channel& channel)
    : channel_(channel), order_(role, "coupler") {}

FramedMessage Conversation::next() {
    enter(timeline_, Timeline::Part::wait, "wait for the coupler", order_.window());
    for (Patience patience;; patience.wait(channel_.in_transit())) {
        if (auto frame = channel_.try_receive()) {
            enter(timeline_, Timeline::Part::transfer, "receive", order_.window());
            return FramedMessage(std::move(frame->bytes));
        }
        // Only this wait is limited: what the adapter computes in between is not counted.
        if (patience.seconds() > limit_)
            throw CouplerSilent("the coupler has been silent for " +
                                std::to_string(static_cast<int>(limit_)) + " s while " +
                                order_.due_text() + " was expected");
    }
}

void Conversation::send(Kind kind) {
    channel_.send(0, frame({order_.next_sent(kind, to_coupler), {}}));
}

void Conversation::flush_sent() {
    // in_transit() ends this when the other side is busy: the rest moves when it looks again.
    for (Patience patience; !channel_.flushed() && channel_.in_transit();) patience.wait(true);
}

FramedMessage Conversation::receive() {
    FramedMessage message = next();
    // Before a dismissal is obeyed as well: kind and place are checked, a lost message is not held
    // against it.
    order_.received(message.envelope, from_coupler);
    if (message.envelope.kind == Kind::dismiss) throw Dismissed{decode<Verdict>(message.payload())};
    return message;
}

FramedMessage Conversation::receive(Kind kind) {
    FramedMessage message = receive();
    if (message.envelope.kind != kind)
        throw OrderViolation("the adapter waits for \"" + kind_name(kind) +
                             "\", the coupler sent \"" + kind_name(message.envelope.kind) + "\"");
    return message;
}

Verdict Conversation::fail(const Verdict& verdict) {
    send(Kind::failure, verdict);
    for (;;) {  // frames still in flight are no longer needed
        const FramedMessage message = next();
        // Not passed to the order: what is discarded does not count as received.
        if (message.envelope.kind != Kind::dismiss) continue;
        order_.received(message.envelope, from_coupler);
        return decode<Verdict>(message.payload());
    }
}

void Conversation::say_farewell() {
    send(Kind::farewell);
    // `release`: all ranks of all programs have said farewell.
    order_.received(next().envelope, from_coupler);
}

}  // namespace turbidite
