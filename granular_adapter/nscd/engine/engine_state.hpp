// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Serialisation of bodies, walls and contact memory. Tags identify the format: bytes of another
// kind or version are refused.
#pragma once

#include <unordered_map>

#include "granular_adapter/nscd/laws/contact_states.hpp"
#include "granular_adapter/nscd/problem/bodies.hpp"
#include "granular_adapter/nscd/problem/byte_stream.hpp"
#include "granular_adapter/nscd/problem/walls.hpp"
#include "granular_adapter/nscd/problem/warm_start.hpp"

namespace turbidite::nscd {

/// Appends all arrays of the bodies.
void write_bodies(ByteWriter& out, const Bodies& bodies);

/// Throws std::invalid_argument for anything not written by write_bodies.
Bodies read_bodies(ByteReader& in);

/// The state that one step passes to the next, apart from the bodies.
struct SavedMemory {
    std::vector<RememberedContact> contacts;
    ContactStates::Saved states;
    std::vector<Wall> walls;
    bool space = false;
    std::vector<RememberedContact> moments =
        {};  ///< of contacts in space; not written in the plane
};
void write_memory(ByteWriter& out, const SavedMemory& memory);

/// Other names of bodies and walls: those of a program that the memory is for.
struct KeyNames {
    std::unordered_map<GrainId, GrainId> bodies, walls;
};

/// The memory under these names. Contacts of what has none are left out, and so are pairs of bodies
/// that would change their order: normals and features are of the first one.
SavedMemory renamed(SavedMemory memory, const KeyNames& names);

/// Positions and motions of the walls are read, their other properties taken from `walls`. Throws
/// std::invalid_argument for anything not written by write_memory with the same number of walls and
/// of the same dimension.
SavedMemory read_memory(ByteReader& in, const std::vector<Wall>& walls, bool space);

/// Puts what other ranks have saved behind it; walls are the same for all.
void append(Bodies& all, Bodies bodies);
void append(SavedMemory& all, SavedMemory memory);

/// The bodies in the order of their ids.
void sort_by_id(Bodies& bodies);

/// Throws std::invalid_argument if bytes are left.
void demand_end(const ByteReader& in);

}  // namespace turbidite::nscd
