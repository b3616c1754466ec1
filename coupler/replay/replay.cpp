// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/replay/replay.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>

#include "coupler/protocol/failure.hpp"
#include "coupler/protocol/message.hpp"
#include "coupler/protocol/received.hpp"
#include "coupler/replay/record_numbers.hpp"

namespace turbidite {
namespace {

constexpr std::size_t most_sentences = 10;
constexpr double farewell_limit = 10.0;  // [s]

bool same(double a, double b) {
    // A number that was NaN then and is NaN now has not changed.
    return a == b || (std::isnan(a) && std::isnan(b));
}

std::string text_of(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", number);
    return text;
}

/// "motion" of window 5, rank 0
std::string place_of(const Message& message, int rank) {
    const Envelope& at = message.envelope;
    return "\"" + kind_name(at.kind) + "\" of window " + std::to_string(at.window) +
           (at.iteration > 0 ? ", round " + std::to_string(at.iteration) : std::string()) +
           ", rank " + std::to_string(rank);
}

/// The first number of a table that differs, and the largest relative difference.
struct TableDifference {
    std::string first;  ///< empty: none
    double largest = 0.0;
};

TableDifference difference(const NumberTable& now, const NumberTable& then) {
    // Number by number only where the records are those of the same grains in the same order.
    if (now.ids != then.ids || now.numbers.size() != then.numbers.size())
        return {now.ids.size() == then.ids.size()
                    ? now.what + "s come in another order, or are others"
                    : std::to_string(now.ids.size()) + " records (" + now.what + ") instead of " +
                          std::to_string(then.ids.size()),
                INFINITY};
    const std::size_t per_record = then.names.size();
    // The largest of each quantity over all records of the message: relative to single numbers,
    // rounding near zero would look large.
    std::vector<double> scale(per_record, 0.0);
    for (std::size_t i = 0; i < then.numbers.size(); ++i)
        if (!std::isnan(then.numbers[i]))
            scale[i % per_record] = std::max(scale[i % per_record], std::abs(then.numbers[i]));
    TableDifference result;
    for (std::size_t i = 0; i < then.numbers.size(); ++i) {
        const double a = now.numbers[i], b = then.numbers[i];
        if (same(a, b)) continue;
        const std::size_t name = i % per_record;
        const GrainId id = then.ids[i / per_record];
        if (result.first.empty())
            // Records without an id have a negative one.
            result.first = then.what + (id < 0 ? "" : " " + std::to_string(id)) + ": " +
                           then.names[name] + " = " + text_of(a) + " instead of " + text_of(b);
        const double relative = std::abs(a - b) / (scale[name] > 0.0 ? scale[name] : 1.0);
        result.largest = std::max(result.largest, std::isnan(relative) ? INFINITY : relative);
    }
    return result;
}

class Replay {
 public:
    Replay(Recording& recording, Channel& participant, const ReplayOrder& order)
        : recording_(recording),
          channel_(participant),
          order_(order),
          arrived_(static_cast<std::size_t>(participant.peers())),
          last_(arrived_.size()),
          sent_(arrived_.size(), 0),
          dismissed_(arrived_.size(), false),
          left_(arrived_.size(), false),
          released_(arrived_.size(), false) {}

    ReplayReport play() {
        demand_ranks();
        try {
            // In the order in which the coupler had sent and received: what it had received is now
            // waited for before anything later is sent.
            while (auto frame = recording_.next())
                if (frame->sent_by_coupler)
                    send(*frame);
                else
                    compare(frame->peer, unframe(frame->bytes));
        } catch (const Failure& failure) {
            dismiss({static_cast<std::int64_t>(failure.code()), failure.what()});
            throw;
        }
        // A run that was killed, or that failed: the recording ends before the participant may
        // leave.
        if (std::find(released_.begin(), released_.end(), false) != released_.end()) {
            report_.complete = false;
            dismiss({0, "the recording ends here"});
        }
        while (!channel_.flushed()) Patience().wait();
        return report_;
    }

 private:
    void demand_ranks() const {
        if (channel_.peers() == recording_.peers()) return;
        throw Failure(ExitCode::handshake_refused,
                      "the recording is of " + std::to_string(recording_.peers()) +
                          " ranks, and the participant has " + std::to_string(channel_.peers()));
    }

    void send(const RecordedFrame& frame) {
        const Envelope envelope = unframe(frame.bytes).envelope;
        const auto peer = static_cast<std::size_t>(frame.peer);
        last_[peer] = envelope;
        ++sent_[peer];
        dismissed_[peer] = dismissed_[peer] || envelope.kind == Kind::dismiss;
        released_[peer] = envelope.kind == Kind::release;
        if (envelope.kind == Kind::window && frame.peer == 0) order_.progress(report_.windows++);
        channel_.send(frame.peer, frame.bytes);
    }

    /// The next message of a rank; nothing if it is silent for too long.
    std::optional<Message> next(int peer, double limit) {
        // Ranks may answer in another order than then: each has a queue.
        auto& queue = arrived_[static_cast<std::size_t>(peer)];
        for (Patience patience; queue.empty(); patience.wait()) {
            if (auto frame = channel_.try_receive())
                arrived_[static_cast<std::size_t>(frame->peer)].push_back(unframe(frame->bytes));
            if (patience.seconds() > limit) return std::nullopt;
        }
        Message message = std::move(queue.front());
        queue.pop_front();
        return message;
    }

    Message receive(int peer, const Message& then) {
        std::optional<Message> message = next(peer, order_.limit);
        if (!message)
            throw Failure(ExitCode::stalled,
                          "it has not sent " + place_of(then, peer) +
                              ", within limits.stall_hard = " + text_of(order_.limit) + " s");
        if (message->envelope.kind != Kind::failure) return std::move(*message);
        const auto verdict = decode<Verdict>(message->payload);
        throw Failure(
            received_code(verdict.exit_code),
            "rank " + std::to_string(peer) + " ended the run: " + received_text(verdict.reason));
    }

    void compare(int peer, const Message& then) {
        last_[static_cast<std::size_t>(peer)] = then.envelope;
        const Message now = receive(peer, then);
        // Not the sequence: it follows from the kinds.
        if (now.envelope.kind != then.envelope.kind ||
            now.envelope.window != then.envelope.window ||
            now.envelope.iteration != then.envelope.iteration)
            throw Failure(ExitCode::participant_failed,
                          "it sent " + place_of(now, peer) + " instead of " + place_of(then, peer));
        left_[static_cast<std::size_t>(peer)] = now.envelope.kind == Kind::farewell;
        ++report_.messages;
        const auto ours = numbers_of(now), theirs = numbers_of(then);
        // E.g. contacts that are now reported and were not then.
        bool differs = ours.size() != theirs.size();
        std::string why = differs ? "it reports other things than then" : "";
        for (std::size_t t = 0; t < std::min(ours.size(), theirs.size()); ++t) {
            const TableDifference table = difference(ours[t], theirs[t]);
            if (table.first.empty()) continue;
            if (why.empty()) why = table.first;
            differs = true;
            report_.largest = std::max(report_.largest, table.largest);
        }
        if (!differs) return;
        ++report_.differences;
        if (report_.first.size() < most_sentences)
            report_.first.push_back(place_of(now, peer) + ": " + why);
    }

    /// Ends the ranks that were not released by the recording, from where it has led each of them:
    /// of a run that stalled it has the farewell of those who were still there.
    void dismiss(const Verdict& verdict) {
        const auto each_not = [&](const std::vector<bool>& so_far, auto end) {
            for (std::size_t peer = 0; peer < released_.size(); ++peer)
                if (!released_[peer] && !so_far[peer]) end(peer);
        };
        // To all before any is waited for: ranks of one program may wait for each other on their
        // way out.
        each_not(dismissed_,
                 [&](std::size_t peer) { send_end(peer, Kind::dismiss, encode(verdict)); });
        each_not(left_, [&](std::size_t peer) {
            for (auto message = next(static_cast<int>(peer), farewell_limit);
                 message && message->envelope.kind != Kind::farewell;)
                message = next(static_cast<int>(peer), farewell_limit);
        });
        each_not(released_, [&](std::size_t peer) { send_end(peer, Kind::release, {}); });
    }

    void send_end(std::size_t peer, Kind kind, Bytes payload) {
        // Window and round of the last message; the number continues what was sent from the
        // recording.
        Envelope envelope = last_[peer];
        envelope.kind = kind;
        envelope.sequence = sent_[peer]++;
        channel_.send(static_cast<int>(peer), frame({envelope, std::move(payload)}));
    }

    Recording& recording_;
    Channel& channel_;
    const ReplayOrder& order_;
    std::vector<std::deque<Message>> arrived_;  // by rank
    std::vector<Envelope> last_;                // sent or compared
    std::vector<std::int64_t> sent_;
    std::vector<bool> dismissed_, left_, released_;  // left: with its farewell
    ReplayReport report_;
};

}  // namespace

ReplayReport replay(Recording& recording, Channel& participant, const ReplayOrder& order) {
    return Replay(recording, participant, order).play();
}

}  // namespace turbidite
