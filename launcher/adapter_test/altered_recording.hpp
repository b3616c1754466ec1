// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What a recording (coupler/transport/recording.hpp) of a trial tells about it, and the same
// recording with a message out of order.
#pragma once

#include <filesystem>
#include <set>

#include "coupler/protocol/message.hpp"
#include "coupler/protocol/records.hpp"

namespace turbidite {

/// Left out together with the answers to it, so that the coupler's next message takes its place.
enum class Alteration { left_out, repeated };

/// Copies a recording with the coupler's message of this kind and window left out or sent twice to
/// every rank. Throws Failure (participant failed) if the recording does not contain it.
void alter_recording(const std::filesystem::path& from, const std::filesystem::path& to, Kind kind,
                     std::int64_t window, Alteration alteration);

/// Grains that were sent by more than one rank in "state": they have changed their owner.
std::set<GrainId> grains_that_moved(const std::filesystem::path& recording);

}  // namespace turbidite
