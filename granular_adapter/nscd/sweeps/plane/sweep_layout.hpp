// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A contact problem in the memory layout for sweeps: schedule, packed groups (Rows), and the bodies
// in the order in which the schedule first uses them, so that a sweep reads memory sequentially.
#pragma once

#include <vector>

#include "granular_adapter/nscd/problem/plane/delassus.hpp"
#include "granular_adapter/nscd/sweeps/contact_schedule.hpp"
#include "granular_adapter/nscd/sweeps/plane/sweep_pack.hpp"

namespace turbidite::nscd {

/// Bodies without mobility are ignored: any number of contacts may use one at the same time.
std::vector<MovedPair> moved_pairs(const ContactProblem& problem);

/// The same contact by contact.
class MovedBodies {
 public:
    explicit MovedBodies(const ContactProblem& problem);
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
class BodySlots {
 public:
    BodySlots(std::size_t bodies, const std::vector<Twist>& velocities,
              const std::vector<BodyMobility>& mobilities)
        : slot_(bodies, -1), velocities_(velocities), mobilities_(mobilities) {}

    /// Slot of a body in the next contact; `body` -1: at rest.
    std::int32_t meet(std::int32_t body, bool moved) {
        if (moved && slot_[static_cast<std::size_t>(body)] >= 0)
            return slot_[static_cast<std::size_t>(body)];
        const auto slot = static_cast<std::int32_t>(bodies.size());
        if (moved) slot_[static_cast<std::size_t>(body)] = slot;
        bodies.push_back(body < 0 ? PlaneBody{} : plane_body(static_cast<std::size_t>(body)));
        return slot;
    }

    std::vector<PlaneBody> bodies;

 private:
    PlaneBody plane_body(std::size_t i) const {
        const Twist& v = velocities_[i];
        return {v.velocity[0], v.velocity[1], v.spin[2], mobilities_[i].xx};
    }

    std::vector<std::int32_t> slot_;
    const std::vector<Twist>& velocities_;
    const std::vector<BodyMobility>& mobilities_;
};

template <class Rows>
struct SweepLayout {
    Schedule schedule;
    std::vector<PlaneBody> bodies;
    std::vector<Rows> rows;
    /// Per group at rest: 1 if it is swept nevertheless, because a contact has gained an impulse.
    std::vector<std::uint8_t> awake;

    SweepLayout(const ContactProblem& problem, const Delassus& w,
                const std::vector<MovedPair>& pairs, const Impulses& r,
                const std::vector<Twist>& velocities, Schedule laid)
        : schedule(std::move(laid)) {
        BodySlots slots(problem.bodies.size(), velocities, problem.bodies);
        make_room();
        for (std::size_t i = 0; i < schedule.lanes.size(); ++i) {
            Rows& row = row_of(i);
            const int lane = static_cast<int>(i % Rows::width);
            if (schedule.lanes[i] < 0) {
                fill_empty(row, lane, slots.meet(-1, false));
                continue;
            }
            const auto k = static_cast<std::size_t>(schedule.lanes[i]);
            const Contact& c = problem.contacts[k];
            const std::int32_t slot_a = slots.meet(c.a, pairs[k].a >= 0);
            const std::int32_t slot_b = slots.meet(c.b, pairs[k].b >= 0);
            fill(row, lane,
                 {c, w.block(k), c.a < 0 ? BodyMobility() : problem.bodies[c.a],
                  problem.bodies[c.b], r[k], slot_a, slot_b});
        }
        bodies = std::move(slots.bodies);
    }

    /// The same state in the groups of another schedule.
    void rearrange(Schedule next) {
        const std::vector<Rows> old = std::move(rows);
        const std::vector<std::size_t> place = places();
        schedule = std::move(next);
        make_room();
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

    void collect(Impulses& r) const {
        each_contact([&](std::size_t k, const Rows& row, int lane) { r[k] = impulse(row, lane); });
    }

    /// By contact, whether it has an impulse.
    std::vector<std::uint8_t> loaded(std::size_t contacts) const {
        std::vector<std::uint8_t> result(contacts);
        each_contact([&](std::size_t k, const Rows& row, int lane) {
            result[k] = row.rn.v[lane] > 0.0 ? 1 : 0;
        });
        return result;
    }

 private:
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
