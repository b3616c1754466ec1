// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/replay/recorded_start.hpp"

#include "coupler/protocol/message.hpp"
#include "coupler/transport/recording.hpp"

namespace turbidite {

std::optional<std::string> first_checkpoint(const std::filesystem::path& file) {
    Recording recording(file);
    while (const auto frame = recording.next()) {
        const Message message = unframe(frame->bytes);
        if (message.envelope.kind == Kind::restore)
            return decode<RestoreOrder>(message.payload).folder;
        // A run that goes on is restored before its first window or not at all.
        if (message.envelope.kind == Kind::window) break;
    }
    return std::nullopt;
}

}  // namespace turbidite
