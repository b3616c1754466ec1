// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/detection/common_edges.hpp"

#include <algorithm>

#include "coupler/rigid/vec3.hpp"

namespace turbidite::nscd {
namespace {

// Of the size of a wall: rounding of places on it.
constexpr double same_place = 1e-9;

/// A contact point with a wall, and where on the wall it is.
struct Foot {
    std::size_t point;
    Vec3 place;
};

const Wall& wall_of(const WallContacts& contacts, const Foot& foot) {
    return contacts.walls[static_cast<std::size_t>(contacts.points[foot.point].wall)];
}

Foot foot_of(const WallContacts& contacts, std::size_t k) {
    const ContactPoint& p = contacts.points[k];
    const double half = contacts.walls[static_cast<std::size_t>(p.wall)].half_thickness;
    // The arm leads from the centre to the body's surface.
    return {k, contacts.bodies.position[p.b] + p.arm_b - (p.gap + half) * p.normal};
}

/// Feet of round bodies on walls with ends, those of a body one after another.
std::vector<Foot> feet_by_body(const WallContacts& contacts) {
    const auto& points = contacts.points;
    std::vector<Foot> feet;
    for (std::size_t k = 0; k < points.size(); ++k) {
        if (points[k].wall < 0 ||
            !contacts.round[static_cast<std::size_t>(contacts.bodies.shape[points[k].b])])
            continue;
        if (has_ends(contacts.walls[static_cast<std::size_t>(points[k].wall)]))
            feet.push_back(foot_of(contacts, k));
    }
    std::stable_sort(feet.begin(), feet.end(), [&](const Foot& f, const Foot& g) {
        return points[f.point].b < points[g.point].b;
    });
    return feet;
}

/// Whether a law acts at `other` instead of at `own`.
bool yields(const WallContacts& contacts, const Foot& own, const Foot& other) {
    const ContactPoint &p = contacts.points[own.point], &q = contacts.points[other.point];
    if (p.wall == q.wall) return false;
    const Wall &wall = wall_of(contacts, own), &another = wall_of(contacts, other);
    const double rounding = same_place * std::max(size_of(wall), size_of(another));
    if (!is_on(another, own.place, rounding)) return false;
    // A thinner wall may be farther away all the same.
    if (p.gap < q.gap - rounding) return false;
    const bool one_foot = q.gap >= p.gap - rounding && is_on(wall, other.place, rounding);
    return !one_foot || q.wall < p.wall;
}

}  // namespace

std::vector<CommonEdge> common_edges(const WallContacts& contacts, double range) {
    const auto body = [&](const Foot& foot) { return contacts.points[foot.point].b; };
    const std::vector<Foot> feet = feet_by_body(contacts);
    std::vector<CommonEdge> edges;
    for (auto first = feet.begin(); first != feet.end();) {
        const auto last = std::find_if(
            first, feet.end(), [&](const Foot& foot) { return body(foot) != body(*first); });
        for (auto own = first; own != last; ++own)
            for (auto other = first; other != last; ++other)
                if (contacts.points[own->point].gap < range && yields(contacts, *own, *other))
                    edges.push_back({own->point, other->point});
        first = last;
    }
    return edges;
}

}  // namespace turbidite::nscd
