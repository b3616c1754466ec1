// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/engine/engine_state.hpp"

#include <algorithm>
#include <stdexcept>

#include "granular_adapter/nscd/ranks/body_rows.hpp"

namespace turbidite::nscd {
namespace {

// First eight bytes of a saved state. Of the memory there are two kinds, since only space has
// moments and sides of rectangles.
constexpr std::uint64_t bodies_format = 0x344445534354ULL;
constexpr std::uint64_t memory_format = 0x354d454d4354ULL;
constexpr std::uint64_t space_format = 0x33324d454d4354ULL;

/// Position and motion of a wall; everything else comes from the settings.
template <class Visit, class AnyWall>
void for_each_state(AnyWall& wall, bool space, Visit&& visit) {
    visit(wall.point), visit(wall.normal), visit(wall.twist.velocity), visit(wall.twist.spin);
    visit(wall.pivot);
    if (space) visit(wall.side);
}

void read_walls(ByteReader& in, bool space, std::vector<Wall>& walls) {
    if (in.value<std::uint64_t>() != walls.size())
        throw std::invalid_argument("saved contact state: the number of walls differs");
    for (Wall& wall : walls)
        for_each_state(wall, space,
                       [&in](auto& value) { value = in.value<std::decay_t<decltype(value)>>(); });
}

GrainId name_in(const std::unordered_map<GrainId, GrainId>& names, GrainId id) {
    const auto found = names.find(id);
    return found == names.end() ? -1 : found->second;
}

/// Whether the contact has a key under these names, which it is given.
bool rename(ContactKey& key, const KeyNames& names) {
    const bool pair = key.wall == 0;
    key.first = name_in(pair ? names.bodies : names.walls, key.first);
    key.second = name_in(names.bodies, key.second);
    return key.first >= 0 && key.second >= 0 && (!pair || key.first < key.second);
}

template <class Remembered>
void rename_all(std::vector<Remembered>& contacts, const KeyNames& names) {
    std::vector<Remembered> kept;
    for (Remembered one : contacts)
        if (rename(one.key, names)) kept.push_back(one);
    std::sort(kept.begin(), kept.end(),
              [](const Remembered& a, const Remembered& b) { return a.key < b.key; });
    contacts = std::move(kept);
}

}  // namespace

SavedMemory renamed(SavedMemory memory, const KeyNames& names) {
    rename_all(memory.contacts, names);
    rename_all(memory.states.accepted, names);
    rename_all(memory.states.found, names);
    rename_all(memory.moments, names);
    return memory;
}

void write_bodies(ByteWriter& out, const Bodies& bodies) {
    out.value(bodies_format);
    Bodies::for_each_array(bodies, [&out](const auto& array) { out.array(array); });
}

Bodies read_bodies(ByteReader& in) {
    if (in.value<std::uint64_t>() != bodies_format)
        throw std::invalid_argument("saved contact state: unknown format");
    Bodies bodies;
    Bodies::for_each_array(bodies, [&in](auto& array) {
        array = in.array<typename std::decay_t<decltype(array)>::value_type>();
    });
    Bodies::for_each_array(bodies, [&bodies](const auto& array) {
        if (array.size() != bodies.size())
            throw std::invalid_argument("saved contact state: arrays of different lengths");
    });
    return bodies;
}

void write_memory(ByteWriter& out, const SavedMemory& memory) {
    out.value(memory.space ? space_format : memory_format);
    out.array(memory.contacts);
    out.value(static_cast<std::uint8_t>(memory.states.started));
    out.array(memory.states.accepted);
    out.array(memory.states.found);
    out.value(static_cast<std::uint64_t>(memory.walls.size()));
    for (const Wall& wall : memory.walls)
        for_each_state(wall, memory.space, [&out](const auto& value) { out.value(value); });
    if (memory.space) out.array(memory.moments);
}

SavedMemory read_memory(ByteReader& in, const std::vector<Wall>& walls, bool space) {
    if (in.value<std::uint64_t>() != (space ? space_format : memory_format))
        throw std::invalid_argument("saved contact impulses: unknown format");
    SavedMemory memory;
    memory.contacts = in.array<RememberedContact>();
    memory.states.started = in.value<std::uint8_t>() != 0;
    memory.states.accepted = in.array<RememberedState>();
    memory.states.found = in.array<RememberedState>();
    memory.walls = walls;
    read_walls(in, space, memory.walls);
    memory.space = space;
    if (space) memory.moments = in.array<RememberedContact>();
    return memory;
}

namespace {

template <class Entry>
void append_entries(std::vector<Entry>& all, const std::vector<Entry>& more) {
    all.insert(all.end(), more.begin(), more.end());
}

/// In the order of the keys; each is there once, since one rank keeps it.
void sort_by_key(std::vector<RememberedState>& states) {
    std::sort(states.begin(), states.end(),
              [](const RememberedState& a, const RememberedState& b) { return a.key < b.key; });
}

}  // namespace

void append(Bodies& all, Bodies bodies) {
    const Bodies more = std::move(bodies);
    std::vector<const void*> arrays;
    Bodies::for_each_array(more, [&](const auto& array) { arrays.push_back(&array); });
    std::size_t at = 0;
    // Arrays are visited in the same order in both, so that the n-th pointer is of the same type.
    Bodies::for_each_array(all, [&](auto& array) {
        append_entries(array, *static_cast<const std::decay_t<decltype(array)>*>(arrays[at++]));
    });
}

void append(SavedMemory& all, SavedMemory memory) {
    append_entries(all.contacts, memory.contacts);
    append_entries(all.moments, memory.moments);
    append_entries(all.states.accepted, memory.states.accepted);
    append_entries(all.states.found, memory.states.found);
    sort_by_key(all.states.accepted), sort_by_key(all.states.found);
    all.states.started = all.states.started || memory.states.started;
    all.walls = std::move(memory.walls);
    all.space = memory.space;
}

void sort_by_id(Bodies& bodies) {
    take_rows(order_of_ids(bodies),
              [&](const auto& each) { Bodies::for_each_array(bodies, each); });
}

void demand_end(const ByteReader& in) {
    if (!in.at_end())
        throw std::invalid_argument("saved contact state: unexpected data at the end");
}

}  // namespace turbidite::nscd
