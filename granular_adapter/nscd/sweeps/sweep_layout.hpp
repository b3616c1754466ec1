// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A contact problem in the memory layout for sweeps: schedule, packed groups (Rows), and the bodies
// in the order in which the schedule first uses them, so that a sweep reads memory sequentially.
//
// A kind of contact (contact_kind.hpp) gives for its rows
//
//     Rows::width, Rows::Body, Rows::Base    lanes; the data of a body; where `a` and `b` are
//     rows.a, rows.b, rows.rn                slots of the bodies, normal impulses
//     fill(rows, lane, contact)              packs a contact, from a ContactToPack
//     fill_empty(rows, lane, slot)           a lane without one, which never closes
//     impulse(rows, lane)                    the impulse of a packed contact
//     moment(rows, lane)                     in space: its moment, if rows have some
//     impulse_lanes(rows)                    impulses and moments of a group: an array of Lanes
//     set_impulse_lanes(rows, impulses)      takes them over
//     packed_body(twist, mobility)           a Rows::Body
//     copy_rates(body, to)                   its velocity and spin as six doubles, for other ranks
//     set_rates(body, from)                  takes them over
#pragma once

#include <cstddef>
#include <cstring>
#include <vector>

#include "granular_adapter/nscd/problem/contact_kind.hpp"
#include "granular_adapter/nscd/sweeps/contact_schedule.hpp"
#include "granular_adapter/nscd/sweeps/sweeps.hpp"

namespace turbidite::nscd {

/// A contact with the data to be packed; an immovable body has zero mobility.
template <class Mobility, class Block>
struct ContactToPack {
    const Contact& contact;
    const Block& w;
    Mobility a, b;
    ContactVector r;
    std::int32_t slot_a, slot_b;
    Vec3 moment{};
};

/// The bodies that the impulse of a contact can move. Bodies without mobility are ignored: any
/// number of contacts may use one at the same time.
class MovedBodies {
 public:
    template <MobilityKind Mobility>
    explicit MovedBodies(const std::vector<Mobility>& bodies) : moved_(bodies.size()) {
        for (std::size_t i = 0; i < moved_.size(); ++i)
            moved_[i] = is_immovable(bodies[i]) ? -1 : static_cast<std::int32_t>(i);
    }

    MovedPair of(const Contact& contact) const {
        return {contact.a < 0 ? -1 : moved_[static_cast<std::size_t>(contact.a)],
                moved_[static_cast<std::size_t>(contact.b)]};
    }

 private:
    std::vector<std::int32_t> moved_;  ///< the body itself, -1: without mobility
};

/// Memory slots for the bodies of a schedule. A movable body has one. Everything else (a wall, an
/// immovable body, the body of an empty lane) gets one per contact, so that no update has to wait
/// for another because of it.
template <class Body, class Mobility>
class BodySlots {
 public:
    BodySlots(const std::vector<Twist>& velocities, const std::vector<Mobility>& mobilities)
        : slot_(mobilities.size(), -1), velocities_(velocities), mobilities_(mobilities) {}

    /// Slot of a body in the next contact; `body` -1: at rest.
    std::int32_t meet(std::int32_t body, bool moved) {
        const auto i = static_cast<std::size_t>(body);
        if (moved && slot_[i] >= 0) return slot_[i];
        const auto slot = static_cast<std::int32_t>(bodies.size());
        if (moved) slot_[i] = slot;
        bodies.push_back(body < 0 ? Body{} : packed_body(velocities_[i], mobilities_[i]));
        return slot;
    }

    std::vector<Body> bodies;

    /// By body; -1 for one that has none of its own.
    std::vector<std::int32_t> take_slots() { return std::move(slot_); }

 private:
    std::vector<std::int32_t> slot_;
    const std::vector<Twist>& velocities_;
    const std::vector<Mobility>& mobilities_;
};

/// Copies a lane: all members of Rows are lanes of doubles, apart from the body slots.
template <class Rows>
void copy_lane(const Rows& from, int lane_from, Rows& to, int lane_to) {
    using Base = typename Rows::Base;
    constexpr std::size_t size = sizeof(Lanes<Rows::width>), value = sizeof(double);
    constexpr std::size_t places = offsetof(Base, a);
    static_assert(sizeof(Rows) % size == 0 && places % size == 0 && 2 * sizeof(Base::a) == size);
    const auto* const source = reinterpret_cast<const std::byte*>(&from) + value * lane_from;
    auto* const target = reinterpret_cast<std::byte*>(&to) + value * lane_to;
    for (std::size_t at = 0; at < sizeof(Rows); at += size)
        if (at != places) std::memcpy(target + at, source + at, value);
    to.a[lane_to] = from.a[lane_from];
    to.b[lane_to] = from.b[lane_from];
}

template <class Rows>
struct SweepLayout {
    Schedule schedule;
    std::vector<typename Rows::Body> bodies;
    std::vector<std::int32_t> slots;  ///< by body of the problem; -1: it moves in no contact
    std::vector<Rows> rows;
    /// Per group at rest: 1 if it is swept nevertheless, because a contact has gained an impulse.
    std::vector<std::uint8_t> awake;

    template <ContactOperator W>
    SweepLayout(const ContactProblem& problem, const W& w, const std::vector<MovedPair>& pairs,
                const Impulses& r, const std::vector<Twist>& velocities, Schedule laid)
        : schedule(std::move(laid)) {
        using Mobility = typename W::Mobility;
        BodySlots<typename Rows::Body, Mobility> placed(velocities, w.bodies());
        make_room();
        for (std::size_t i = 0; i < schedule.lanes.size(); ++i) {
            Rows& row = row_of(i);
            const int lane = static_cast<int>(i % Rows::width);
            if (schedule.lanes[i] < 0) {
                fill_empty(row, lane, placed.meet(-1, false));
                continue;
            }
            const auto k = static_cast<std::size_t>(schedule.lanes[i]);
            const Contact& c = problem.contacts[k];
            const std::int32_t slot_a = placed.meet(c.a, pairs[k].a >= 0);
            const std::int32_t slot_b = placed.meet(c.b, pairs[k].b >= 0);
            fill(row, lane,
                 ContactToPack<Mobility, typename W::Block>{
                     c, w.block(k), c.a < 0 ? Mobility() : w.bodies()[c.a], w.bodies()[c.b], r[k],
                     slot_a, slot_b, r.moments.empty() ? Vec3{} : r.moments[k]});
        }
        bodies = std::move(placed.bodies);
        placed_ = bodies.size();
        slots = placed.take_slots();
    }

    /// The same state in the groups of another schedule.
    void rearrange(Schedule next) {
        const std::vector<Rows> old = std::move(rows);
        const std::vector<std::size_t> place = places();
        schedule = std::move(next);
        make_room();
        bodies.resize(placed_);  // without those of the empty lanes of the last one
        for (std::size_t i = 0; i < schedule.lanes.size(); ++i) {
            Rows& row = row_of(i);
            const int lane = static_cast<int>(i % Rows::width);
            if (schedule.lanes[i] < 0) {
                fill_empty(row, lane, static_cast<std::int32_t>(bodies.size()));
                bodies.emplace_back();
                continue;
            }
            const std::size_t from = place[static_cast<std::size_t>(schedule.lanes[i])];
            copy_lane(old[from / Rows::width], static_cast<int>(from % Rows::width), row, lane);
        }
    }

    /// Calls visit(slot) for both bodies of all lanes of a stretch.
    template <class Visit>
    void each_slot(const Stretch& stretch, const Visit& visit) const {
        for (const GroupRange& range : {stretch.active, stretch.resting})
            for (std::int32_t group = range.first; group < range.last; ++group) {
                const Rows& row = rows[static_cast<std::size_t>(group)];
                for (int lane = 0; lane < Rows::width; ++lane) {
                    visit(static_cast<std::size_t>(row.a[lane]));
                    visit(static_cast<std::size_t>(row.b[lane]));
                }
            }
    }

    void collect(Impulses& r) const {
        each_contact([&](std::size_t k, const Rows& row, int lane) { r[k] = impulse(row, lane); });
        if constexpr (requires(const Rows& row) { moment(row, 0); }) {
            r.moments.resize(r.size());
            each_contact([&](std::size_t k, const Rows& row, int lane) {
                r.moments[k] = moment(row, lane);
            });
        }
    }

    /// By body of the problem.
    void set_velocities(const std::vector<Twist>& velocities) {
        for (std::size_t i = 0; i < slots.size(); ++i) {
            if (slots[i] < 0) continue;
            const auto& [v, w] = velocities[i];
            const double rates[] = {v[0], v[1], v[2], w[0], w[1], w[2]};
            set_rates(bodies[static_cast<std::size_t>(slots[i])], rates);
        }
    }

    /// By contact, whether it has an impulse.
    std::vector<std::uint8_t> loaded(std::size_t contacts) const {
        std::vector<std::uint8_t> result(contacts);
        each_contact([&](std::size_t k, const Rows& row, int lane) {
            result[k] = row.rn.v[lane] != 0.0 ? 1 : 0;
        });
        return result;
    }

 private:
    std::size_t placed_ = 0;  ///< bodies of the first schedule

    void make_room() {
        rows.clear();
        rows.reserve(static_cast<std::size_t>(schedule.all));
        awake.assign(static_cast<std::size_t>(schedule.all - schedule.active), 0);
    }

    /// The row of lane i; rows are appended one after the other.
    Rows& row_of(std::size_t i) { return i % Rows::width == 0 ? rows.emplace_back() : rows.back(); }

    template <class Visit>
    void each_contact(const Visit& visit) const {
        for (std::size_t i = 0; i < schedule.lanes.size(); ++i)
            if (schedule.lanes[i] >= 0)
                visit(static_cast<std::size_t>(schedule.lanes[i]), rows[i / Rows::width],
                      static_cast<int>(i % Rows::width));
    }

    /// Lane of each contact.
    std::vector<std::size_t> places() const {
        std::vector<std::size_t> result(schedule.lanes.size());
        for (std::size_t i = 0; i < schedule.lanes.size(); ++i)
            if (schedule.lanes[i] >= 0) result[static_cast<std::size_t>(schedule.lanes[i])] = i;
        return result;
    }
};

}  // namespace turbidite::nscd
