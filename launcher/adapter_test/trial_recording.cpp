// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/adapter_test/trial_recording.hpp"

#include <algorithm>

#include "coupler/protocol/message.hpp"
#include "coupler/transport/recording.hpp"

namespace turbidite {
namespace {

/// Calls use(message, rank) for what the program has sent, until it returns false. A coupler that
/// was ended by a crash may have left no recording.
template <class Use>
void for_each_sent(const std::filesystem::path& file, Use use) {
    if (!std::filesystem::exists(file)) return;
    Recording recording(file);
    while (const auto frame = recording.next())
        if (!frame->sent_by_coupler && !use(unframe(frame->bytes), frame->peer)) return;
}

/// The first message of this kind, decoded.
template <class Record>
std::optional<Record> first(const std::filesystem::path& file, Kind kind) {
    std::optional<Record> found;
    for_each_sent(file, [&](const Message& message, int) {
        if (message.envelope.kind == kind) found = decode<Record>(message.payload);
        return !found;
    });
    return found;
}

void add(Motion& whole, const Motion& share) {
    whole.grains.insert(whole.grains.end(), share.grains.begin(), share.grains.end());
    whole.report.max_penetration =
        std::max(whole.report.max_penetration, share.report.max_penetration);
    if (!share.contacts) return;
    if (!whole.contacts) whole.contacts.emplace();
    whole.contacts->insert(whole.contacts->end(), share.contacts->begin(), share.contacts->end());
}

}  // namespace

Capabilities capabilities_of(const std::filesystem::path& recording) {
    return first<Hello>(recording, Kind::hello).value_or(Hello{}).capabilities;
}

std::optional<std::string> failure_told(const std::filesystem::path& recording) {
    const auto verdict = first<Verdict>(recording, Kind::failure);
    return verdict ? std::optional(verdict->reason) : std::nullopt;
}

std::string save_fault(const std::filesystem::path& recording) {
    std::string fault;
    for_each_sent(recording, [&](const Message& message, int) {
        if (message.envelope.kind == Kind::saved) fault = decode<SavedPart>(message.payload).fault;
        return fault.empty();
    });
    return fault;
}

std::vector<Motion> states_of(const std::filesystem::path& recording) {
    std::vector<Motion> states;
    for_each_sent(recording, [&](const Message& message, int) {
        if (message.envelope.kind != Kind::state) return true;
        // The state of the start has window -1 and comes first: index = window + 1. Shares of
        // several ranks are added up.
        states.resize(static_cast<std::size_t>(message.envelope.window + 2));
        add(states.back(), decode<Motion>(message.payload));
        return true;
    });
    for (Motion& state : states)
        std::sort(state.grains.begin(), state.grains.end(),
                  [](const GrainState& a, const GrainState& b) { return a.id < b.id; });
    return states;
}

}  // namespace turbidite
