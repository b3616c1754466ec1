// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Groups of contacts that share no body, so that the vector unit updates a group at once and the
// result is, bit for bit, that of one contact after the other in the order given.
//
// List scheduling: contact by contact, in order, into the first group with a free lane that comes
// at least `distance` groups after every group that touches one of its bodies. Contacts of one body
// keep their order, all others commute. The distance keeps groups that wait for each other's
// velocities apart, so that the processor works on several at once.
//
// Groups open at a time are few, so that a contact is never far from its place in the order: memory
// is read in order, and a second sweep may follow a first one closely (sweep_pipeline.hpp).
//
// Contacts that are expected to have an impulse share groups with each other only, and so do those
// that rest. Sweeps may leave out groups at rest (nlgs.cpp). Stretch by stretch of the order they
// go through the active groups first, so that whatever is left out, all that is done in one place
// is done at one time.
#pragma once

#include <cstdint>
#include <vector>

namespace turbidite::nscd {

/// The bodies of a contact that its impulse moves; -1: none.
struct MovedPair {
    std::int32_t a = -1;
    std::int32_t b = -1;
};

struct ScheduleSettings {
    int width = 4;      ///< lanes of a group
    int distance = 2;   ///< groups from one contact of a body to the next, >= 1
    int stretch = 512;  ///< contacts of a stretch, about
};

/// Groups [first, last).
struct GroupRange {
    std::int32_t first = 0, last = 0;
};

/// A piece of the order: its active groups, then its groups at rest.
struct Stretch {
    GroupRange active, resting;
    /// Stretches that a sweep must have done before the next one may do this: the last of them
    /// touches a body of this one.
    std::int32_t after = 0;
};

struct Schedule {
    std::vector<std::int32_t> lanes;  ///< contact of each lane, group by group; -1: empty
    std::int32_t active = 0;          ///< groups, the first ones
    std::int32_t all = 0;             ///< all groups
    std::vector<Stretch> stretches;
};

/// Places the contacts in their order; `active[k]` is not zero where contact k is expected to have
/// an impulse. `bodies`: one more than the largest body.
Schedule make_schedule(const std::vector<MovedPair>& pairs, const std::vector<std::uint8_t>& active,
                       std::size_t bodies, const ScheduleSettings& settings);

}  // namespace turbidite::nscd
