// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Groups of contacts that share no body, so that the vector unit can update a group at once with
// bitwise the result of updating one contact after the other in the given order.
//
// List scheduling: each contact, in order, goes into the first group with a free lane that comes at
// least `distance` groups after every group that touches one of its bodies. Contacts of one body
// keep their order; all others commute. The distance separates groups that depend on each other's
// velocities, so that the processor can work on several at once.
//
// Few groups are open at a time, so that a contact never moves far from its place in the order:
// memory is read in order, and a second sweep can follow the first one closely
// (sweep_pipeline.hpp).
//
// Active contacts, those expected to have an impulse, share groups only with each other, and so do
// the others, which are at rest (inactive). Sweeps may skip groups at rest (nlgs.hpp). The order is
// divided into stretches, and each stretch has its active groups first: whatever is skipped, work
// on one region of space is done at one time.
#pragma once

#include <cstdint>
#include <vector>

namespace turbidite::nscd {

/// The bodies of a contact that its impulse can move; -1: none.
struct MovedPair {
    std::int32_t a = -1;
    std::int32_t b = -1;
};

struct ScheduleSettings {
    int width = 4;      ///< lanes per group
    int distance = 2;   ///< groups from one contact of a body to the next, >= 1
    int stretch = 512;  ///< approximate number of contacts per stretch
};

/// The groups [first, last).
struct GroupRange {
    std::int32_t first = 0, last = 0;
};

/// A section of the order: its active groups, then its groups at rest.
struct Stretch {
    GroupRange active, resting;
    /// Number of stretches a sweep must have completed before the next sweep may do this one: the
    /// last of them touches a body of this stretch.
    std::int32_t after = 0;
};

struct Schedule {
    std::vector<std::int32_t> lanes;  ///< contact of each lane, group by group; -1: empty lane
    std::int32_t active = 0;          ///< number of active groups, which come first
    std::int32_t all = 0;             ///< number of groups
    std::vector<Stretch> stretches;

    bool by_cells = false;                ///< of cell_schedule.hpp
    std::vector<std::size_t> cell_ends;   ///< by cell, the number of stretches up to its end
    std::vector<std::size_t> phase_ends;  ///< the same by phase; empty if there is one
};

/// Assigns the contacts to groups; `active[k]` is non-zero if contact k is expected to have an
/// impulse. `bodies`: number of bodies.
Schedule make_schedule(const std::vector<MovedPair>& pairs, const std::vector<std::uint8_t>& active,
                       std::size_t bodies, const ScheduleSettings& settings);

/// Adds the lanes of groups at rest to a schedule that has all others and its stretches, whose
/// ranges of groups at rest begin at 0, and sets Stretch::after.
void complete(Schedule& schedule, const std::vector<std::int32_t>& resting,
              const std::vector<MovedPair>& pairs, std::size_t bodies, int width);

}  // namespace turbidite::nscd
