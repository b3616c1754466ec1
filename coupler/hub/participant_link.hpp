// SPDX-License-Identifier: LGPL-2.1-or-later
//
// One participant as the coupler sees it: its ranks, the message each of them is due to send, and
// since when.
#pragma once

#include <deque>
#include <string>
#include <utility>
#include <vector>

#include "coupler/protocol/call_order.hpp"
#include "coupler/transport/channel.hpp"

namespace turbidite {

class ParticipantLink {
 public:
    using Clock = std::chrono::steady_clock;

    ParticipantLink(Role role, Channel& channel);

    Role role() const { return role_; }
    int ranks() const { return static_cast<int>(ranks_.size()); }
    std::string rank_name(int rank) const;
    /// For error messages: "grains rank 0 (my-code, host h, log l)", as far as it is known.
    std::string who(int rank) const;
    /// "grains (my-code)".
    std::string program() const;

    /// What the rank reported about itself; empty before its hello.
    const Hello& hello(int rank) const { return ranks_[rank].hello; }
    /// Its texts are mended (protocol/received.hpp).
    void set_hello(int rank, Hello hello);
    /// Sets the messages of a window; to be called before the start is over.
    void set_window_order(const Order& order);

    /// Between two windows: the run goes on after so many.
    void go_on_after(std::int64_t windows);

    /// A message without content.
    void send(int rank, Kind kind);
    template <class Record>
    void send(int rank, Kind kind, const Record& record) {
        post(rank, framed(next_sent(rank, kind), record));
    }
    template <class Record>
    void send_all(Kind kind, const Record& record) {
        for (int rank = 0; rank < ranks(); ++rank) send(rank, kind, record);
    }
    template <class Record>
    void send_each(Kind kind, const std::vector<Record>& records) {
        for (int rank = 0; rank < ranks(); ++rank) send(rank, kind, records[rank]);
    }

    /// Accepts the messages that have arrived, checked against the call order. Throws Failure when
    /// a rank reports one. Returns whether anything arrived.
    bool pump();

    /// A long frame is on its way, see Channel.
    bool in_transit() const { return channel_.in_transit(); }

    /// The present window, as the coupler's order counts; -1 before the first.
    std::int64_t window() const { return ranks_.front().order.window(); }

    /// True when every rank has delivered a message of this kind.
    bool ready(Kind kind) const;

    /// The first rank that has not, as `who` names it, and how many others there are.
    std::string silent(Kind kind) const;

    /// The payloads that `ready` announced, one per rank. Throws Failure naming the rank whose
    /// payload does not have the form of this kind.
    template <class Record>
    std::vector<Record> take(Kind kind) {
        std::vector<Record> records;
        const std::vector<FramedMessage> messages = take_messages(kind);
        for (int rank = 0; rank < ranks(); ++rank) try {
                records.push_back(decode<Record>(messages[rank].payload()));
            } catch (const MalformedPayload& fault) {
                refuse_payload(rank, kind, fault.what());
            }
        return records;
    }

    /// Takes messages of no content.
    void discard(Kind kind) { take_messages(kind); }

    /// The ranks whose state has changed since the last call, by a message of theirs or to them.
    std::vector<int> take_changed() { return std::exchange(changed_, {}); }

    /// "grains rank 0 (host h, pid 12) works towards "motion", window 4, since 3 s".
    std::string state_of(int rank) const;

    /// The run is over: dismisses the ranks; whatever they still send is discarded until `gone`.
    void dismiss(const Verdict& verdict);
    bool gone();

    /// All ranks have said farewell: they may leave.
    void release();
    bool flushed() { return channel_.flushed(); }

 private:
    struct Rank {
        CallOrder order;
        Hello hello;
        std::deque<FramedMessage> inbox;
        Clock::time_point since = Clock::now();
    };

    static bool has_delivered(const Rank& rank, Kind kind);
    Envelope next_sent(int rank, Kind kind);
    void post(int rank, Bytes frame);
    FramedMessage unpack(Channel::Frame frame) const;
    void take_in(int rank, FramedMessage message);
    void note_change(int rank);
    std::vector<FramedMessage> take_messages(Kind kind);
    Verdict verdict_of(int rank, const FramedMessage& message) const;
    [[noreturn]] void raise(int rank, const Verdict& verdict) const;
    [[noreturn]] void refuse_payload(int rank, Kind kind, const std::string& fault) const;

    Role role_;
    Channel& channel_;
    std::vector<Rank> ranks_;
    std::vector<int> changed_;
};

}  // namespace turbidite
