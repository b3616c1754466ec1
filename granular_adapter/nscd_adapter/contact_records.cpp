// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd_adapter/contact_records.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "coupler/rigid/vec3.hpp"

namespace turbidite {
namespace {

// The local solution of a sliding contact lies on the cone to rounding.
constexpr double at_limit = 1.0 - 1e-9;

/// Status from the solution of the contact problem without what films carry: its cone is that of
/// the law, also with attraction. A contact under traction neither slides nor rolls.
std::int32_t status_of(const nscd::Contact& contact, const nscd::ContactVector& solution,
                       const Vec3& moment) {
    std::int32_t status = 0;
    if (!(solution.n > 0.0)) return status;
    if (nscd::tangential(solution) >= at_limit * contact.friction * solution.n)
        status |= ContactStatus::sliding;
    // The part that rolling resistance limits; along the normal it is torsion. In the plane the
    // moment is along e_z, and all of it is rolling.
    const Vec3 across = moment - dot(contact.normal, moment) * contact.normal;
    if (contact.rolling > 0.0 && norm(across) >= at_limit * contact.rolling * solution.n)
        status |= ContactStatus::rolling;
    return status;
}

ContactRecord record_of(const nscd::Engine& engine, std::size_t k) {
    const nscd::Bodies& bodies = engine.bodies_of_points();
    const nscd::ContactPoint& point = engine.points()[k];
    const nscd::Contact& contact = engine.problem().contacts[k];
    const nscd::ContactVector& impulse = engine.impulses()[k];
    ContactRecord record;
    record.b = bodies.id[point.b];
    if (point.wall >= 0)
        record.wall = engine.walls_of_points()[static_cast<std::size_t>(point.wall)].key;
    else
        record.a = bodies.id[point.a];
    record.feature = point.feature;
    record.status = status_of(contact, engine.carried()[k], world_moment(engine.carried(), k));
    if (!(engine.carried()[k].n > 0.0) && engine.solution()[k].n != 0.0)
        record.status |= ContactStatus::film;
    record.gap = point.gap;
    record.length = point.length;
    // What acts across a gap, a film or an attraction, begins at the surface of a wall.
    const Vec3 to_wall = std::max(point.gap, 0.0) * point.normal;
    const Vec3 arm_b = point.wall >= 0 ? point.arm_b - to_wall : point.arm_b;
    record.point = bodies.position[point.b] + arm_b;
    record.normal = point.normal;
    // Both arms end at the same point: x_b - x_a = arm_a - arm_b, of the nearest image.
    record.branch = (point.wall >= 0 ? Vec3{} : point.arm_a) - arm_b;
    record.impulse = world_impulse(contact, impulse);
    record.rolling_impulse = world_moment(engine.impulses(), k);
    return record;
}

}  // namespace

std::vector<ContactRecord> contact_records(const nscd::Engine& engine) {
    std::vector<ContactRecord> records;
    // Where attraction and the pressure it causes cancel, the bodies touch although the net force
    // is zero.
    for (std::size_t k = 0; k < engine.points().size(); ++k)
        if (engine.impulses()[k] != nscd::ContactVector{} ||
            engine.solution()[k] != nscd::ContactVector{})
            records.push_back(record_of(engine, k));
    std::sort(records.begin(), records.end(), contact_before);
    return records;
}

void drop_contacts_of(const std::vector<GrainId>& gone, std::vector<ContactRecord>& contacts) {
    if (gone.empty()) return;
    const std::unordered_set<GrainId> left(gone.begin(), gone.end());
    std::erase_if(contacts, [&](const ContactRecord& contact) {
        return left.count(contact.b) > 0 || (contact.wall < 0 && left.count(contact.a) > 0);
    });
}

}  // namespace turbidite
