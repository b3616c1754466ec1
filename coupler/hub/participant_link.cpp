// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/hub/participant_link.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "coupler/protocol/failure.hpp"
#include "coupler/protocol/received.hpp"

namespace turbidite {

ParticipantLink::ParticipantLink(Role role, Channel& channel) : role_(role), channel_(channel) {
    for (int rank = 0; rank < channel.peers(); ++rank) {
        ranks_.push_back(
            {CallOrder(role, fmt::format("{} rank {}", role_name(role), rank)), {}, {}});
        changed_.push_back(rank);
    }
}

std::string ParticipantLink::rank_name(int rank) const {
    return fmt::format("{} rank {}", role_name(role_), rank);
}

std::string ParticipantLink::who(int rank) const {
    const Hello& hello = ranks_[rank].hello;
    // Neither hello nor start record: nothing is known but its number.
    if (hello.host.empty()) return rank_name(rank);
    return fmt::format("{} ({}, host {}, log {})", rank_name(rank), hello.adapter, hello.host,
                       hello.log_file);
}

std::string ParticipantLink::program() const {
    return fmt::format("{} ({})", role_name(role_), ranks_.front().hello.adapter);
}

void ParticipantLink::set_hello(int rank, Hello hello) {
    // Its texts end in messages, logs and the record: mended before anything shows them.
    ranks_[rank].hello = received(std::move(hello));
    ranks_[rank].order.set_peer_name(who(rank));
}

void ParticipantLink::set_window_order(const Order& order) {
    for (Rank& rank : ranks_) rank.order.set_window_order(order);
}

void ParticipantLink::go_on_after(std::int64_t windows) {
    for (Rank& rank : ranks_) rank.order.go_on_after(windows);
}

Envelope ParticipantLink::next_sent(int rank, Kind kind) {
    // Throws where the kind is not due, so that a faulty scheme is found here and not by its
    // partner.
    return ranks_[rank].order.next_sent(kind, from_coupler);
}

void ParticipantLink::post(int rank, Bytes frame) {
    channel_.send(rank, std::move(frame));
    note_change(rank);
}

void ParticipantLink::note_change(int rank) {
    ranks_[rank].since = Clock::now();
    if (changed_.empty() || changed_.back() != rank) changed_.push_back(rank);
}

void ParticipantLink::send(int rank, Kind kind) {
    post(rank, frame({next_sent(rank, kind), {}}));
}

FramedMessage ParticipantLink::unpack(Channel::Frame frame) const {
    try {
        return FramedMessage(std::move(frame.bytes));
    } catch (const MalformedPayload& fault) {
        throw Failure(ExitCode::participant_failed,
                      fmt::format("{} sent what is no frame of the protocol: {}", who(frame.peer),
                                  fault.what()));
    }
}

// Takes what is there from all ranks, whether or not it is waited for now: one side may answer
// while the other is due, and a failure counts as soon as it is here.
bool ParticipantLink::pump() {
    bool any = false;
    while (auto frame = channel_.try_receive()) {
        const int peer = frame->peer;
        take_in(peer, unpack(std::move(*frame)));
        any = true;
    }
    return any;
}

void ParticipantLink::take_in(int rank, FramedMessage message) {
    Rank& from = ranks_.at(rank);
    // Against the call order before the payload is looked at.
    from.order.received(message.envelope, to_coupler);
    note_change(rank);
    if (message.envelope.kind == Kind::failure) raise(rank, verdict_of(rank, message));
    from.inbox.push_back(std::move(message));
}

Verdict ParticipantLink::verdict_of(int rank, const FramedMessage& message) const try {
    return decode<Verdict>(message.payload());
} catch (const MalformedPayload& fault) {
    refuse_payload(rank, Kind::failure, fault.what());
}

void ParticipantLink::raise(int rank, const Verdict& verdict) const {
    // The number is another program's: success, or one that is no exit code, counts as a failure.
    const ExitCode code = received_code(verdict.exit_code);
    const bool strange = static_cast<std::int64_t>(code) != verdict.exit_code;
    throw Failure(code, fmt::format("{}: {}{}", who(rank), received_text(verdict.reason),
                                    strange ? fmt::format(" (with the exit code {}, which no "
                                                          "program of a job may give)",
                                                          verdict.exit_code)
                                            : ""));
}

void ParticipantLink::refuse_payload(int rank, Kind kind, const std::string& fault) const {
    // Of the order after this message: it is the window of the message itself.
    const std::int64_t window = ranks_[rank].order.window();
    const std::string when = window < 0 ? "at the start" : fmt::format("of window {}", window);
    throw Failure(
        ExitCode::participant_failed,
        fmt::format("{}: the payload of \"{}\" {} is malformed: {}. Does the program "
                    "speak protocol {}.{}?",
                    who(rank), kind_name(kind), when, fault, protocol_major, protocol_minor));
}

bool ParticipantLink::has_delivered(const Rank& rank, Kind kind) {
    // The first one only: one rank's messages are used in the order of their sending.
    return !rank.inbox.empty() && rank.inbox.front().envelope.kind == kind;
}

bool ParticipantLink::ready(Kind kind) const {
    return std::all_of(ranks_.begin(), ranks_.end(),
                       [kind](const Rank& rank) { return has_delivered(rank, kind); });
}

std::string ParticipantLink::silent(Kind kind) const {
    std::vector<int> silent;
    for (int rank = 0; rank < ranks(); ++rank)
        if (!has_delivered(ranks_[rank], kind)) silent.push_back(rank);
    if (silent.empty()) return role_name(role_);
    const std::string others =
        silent.size() > 1 ? fmt::format(" and {} other ranks", silent.size() - 1) : "";
    return who(silent.front()) + others;
}

std::vector<FramedMessage> ParticipantLink::take_messages(Kind kind) {
    std::vector<FramedMessage> messages;
    for (Rank& rank : ranks_) {
        if (rank.inbox.empty() || rank.inbox.front().envelope.kind != kind)
            throw OrderViolation(std::string(role_name(role_)) + " has not delivered \"" +
                                 kind_name(kind) + "\" yet");
        messages.push_back(std::move(rank.inbox.front()));
        rank.inbox.pop_front();
    }
    return messages;
}

std::string ParticipantLink::state_of(int rank) const {
    const Rank& of = ranks_[rank];
    const double seconds = std::chrono::duration<double>(Clock::now() - of.since).count();
    // All that is due comes from the same side (CallOrder::due): the first one tells who is waited
    // for.
    const bool waits = of.order.due().front().from_coupler;
    const std::string round =
        of.order.iteration() > 0 ? fmt::format(", round {}", of.order.iteration()) : "";
    const std::string when = of.order.window() < 0
                                 ? " at the start"
                                 : fmt::format(", window {}{}", of.order.window(), round);
    return fmt::format("{} (host {}, pid {}) {} {}{}, for {:.0f} s", rank_name(rank),
                       of.hello.host.empty() ? "unknown" : of.hello.host, of.hello.pid,
                       waits ? "waits for the coupler's" : "is due to send", of.order.due_text(),
                       when, seconds);
}

void ParticipantLink::dismiss(const Verdict& verdict) {
    for (int rank = 0; rank < ranks(); ++rank) send(rank, Kind::dismiss, verdict);
}

bool ParticipantLink::gone() {
    while (auto frame = channel_.try_receive()) {
        try {
            const int peer = frame->peer;
            const Envelope envelope = FramedMessage(std::move(frame->bytes)).envelope;
            // What is still under way from before the dismissal is thrown away, out of order or
            // not.
            if (envelope.kind == Kind::farewell)
                ranks_.at(peer).order.received(envelope, to_coupler);
        } catch (const MalformedPayload&) {  // discarded like all that is not a farewell
        }
    }
    return std::all_of(ranks_.begin(), ranks_.end(), [](const Rank& rank) {
        // Due only after the farewell of this rank.
        return rank.order.due().front().kind == Kind::release;
    });
}

void ParticipantLink::release() {
    for (int rank = 0; rank < ranks(); ++rank) send(rank, Kind::release);
}

}  // namespace turbidite
