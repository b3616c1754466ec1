// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Bodies, walls and contact memory as bytes and back. The tags name the format: bytes of another
// kind or version are refused.
#pragma once

#include "granular_adapter/nscd/laws/contact_states.hpp"
#include "granular_adapter/nscd/problem/bodies.hpp"
#include "granular_adapter/nscd/problem/byte_stream.hpp"
#include "granular_adapter/nscd/problem/walls.hpp"
#include "granular_adapter/nscd/problem/warm_start.hpp"

namespace turbidite::nscd {

void write_bodies(ByteWriter& out, const Bodies& bodies);

/// Throws std::invalid_argument on anything but what write_bodies wrote.
Bodies read_bodies(ByteReader& in);

/// What one step leaves to the next one, bodies apart.
struct SavedMemory {
    std::vector<RememberedContact> contacts;
    ContactStates::Saved states;
    std::vector<Wall> walls;
};
void write_memory(ByteWriter& out, const SavedMemory& memory);

/// Places and motions of walls are read, the rest of them is that of `walls`. Throws
/// std::invalid_argument on anything but what write_memory wrote with as many walls.
SavedMemory read_memory(ByteReader& in, const std::vector<Wall>& walls);

/// Throws std::invalid_argument when bytes are left.
void demand_end(const ByteReader& in);

}  // namespace turbidite::nscd
