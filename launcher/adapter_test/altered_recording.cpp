// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/adapter_test/altered_recording.hpp"

#include <map>
#include <vector>

#include "coupler/protocol/failure.hpp"
#include "coupler/transport/recording.hpp"

namespace turbidite {

void alter_recording(const std::filesystem::path& from, const std::filesystem::path& to, Kind kind,
                     std::int64_t window, Alteration alteration) {
    Recording recording(from);
    std::string fault;
    bool found = false;
    std::optional<RecordingWriter> altered;
    altered.emplace(to, recording.peers(), [&](const std::string& text) { fault = text; });
    std::vector<bool> gap(static_cast<std::size_t>(recording.peers()), false);
    while (const auto frame = recording.next()) {
        const Envelope at = unframe(frame->bytes).envelope;
        const bool chosen = frame->sent_by_coupler && at.kind == kind && at.window == window;
        auto in_gap = gap.begin() + frame->peer;
        // What the rank had answered to the message that is left out must go as well: the gap lasts
        // until the coupler speaks to this rank again.
        if (frame->sent_by_coupler) *in_gap = chosen && alteration == Alteration::left_out;
        if (!*in_gap) altered->write(frame->sent_by_coupler, frame->peer, frame->bytes);
        if (chosen && alteration == Alteration::repeated)
            altered->write(true, frame->peer, frame->bytes);
        found |= chosen;
    }
    altered.reset();  // writes what is left
    if (!fault.empty()) throw Failure(ExitCode::participant_failed, fault);
    if (!found)
        throw Failure(ExitCode::participant_failed, from.string() + " holds no \"" +
                                                        kind_name(kind) + "\" of window " +
                                                        std::to_string(window));
}

std::set<GrainId> grains_that_moved(const std::filesystem::path& recording) {
    Recording frames(recording);
    std::map<GrainId, int> owner;
    std::set<GrainId> moved;
    while (const auto frame = frames.next()) {
        const Message message = unframe(frame->bytes);
        if (message.envelope.kind != Kind::state) continue;
        for (const GrainState& grain : decode<Motion>(message.payload).grains)
            // Compared with the rank that sent it first.
            if (owner.emplace(grain.id, frame->peer).first->second != frame->peer)
                moved.insert(grain.id);
    }
    return moved;
}

}  // namespace turbidite
