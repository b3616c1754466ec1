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
// is read in order, and a second sweep may follow a first one closely (sweep_train.hpp).
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
    int width = 4;     ///< lanes of a group
    int distance = 2;  ///< groups from one contact of a body to the next, >= 1
};

struct Schedule {
    std::vector<std::int32_t> lanes;  ///< contact of each lane, group by group; -1: empty
    std::int32_t head = 0;            ///< groups of the head
    std::int32_t all = 0;             ///< all groups
};

/// Places the contacts `order[0]`, `order[1]`, …; the first `head` of them share no group with the
/// others and come before them. `bodies`: one more than the largest body.
Schedule make_schedule(const std::vector<MovedPair>& pairs, const std::vector<std::int32_t>& order,
                       std::size_t head, std::size_t bodies, const ScheduleSettings& settings);

}  // namespace turbidite::nscd
