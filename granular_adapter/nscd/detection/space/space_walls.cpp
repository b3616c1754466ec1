// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/detection/space/space_walls.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "coupler/rigid/vec3.hpp"
#include "granular_adapter/nscd/detection/narrow_phase.hpp"
#include "granular_adapter/nscd/detection/round_contacts.hpp"

namespace turbidite::nscd {
namespace {

/// Any unit vector normal to a unit vector.
Vec3 normal_to(const Vec3& n) {
    const Vec3 along = std::abs(n[0]) < 0.6 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
    const Vec3 across = cross(n, along);
    return (1.0 / norm(across)) * across;
}

void add_point(const WallView& view, const Vec3& normal, double gap, std::int32_t feature,
               std::vector<ContactPoint>& points) {
    const double radius = view.bodies.radius[view.body];
    points.push_back(
        {-1, view.body, view.wall_index, feature, gap, normal, Vec3{}, -radius * normal});
}

/// A centre in the half-plane beside the axis of a round wall.
struct Beside {
    Beside(const Wall& wall, const Vec3& centre) : axis(wall.normal) {
        const Vec3 arm = centre - wall.point;
        // (rho, h): distance from the axis and height along it. On the axis all directions are
        // alike.
        at.height = dot(arm, axis);
        const Vec3 across = arm - at.height * axis;
        at.radius = norm(across);
        outwards = at.radius > 0.0 ? (1.0 / at.radius) * across : normal_to(axis);
    }
    Vec3 direction(const BesideAxis& x) const { return x.radius * outwards + x.height * axis; }

    Vec3 axis, outwards{};
    BesideAxis at;
};

/// Where a sphere just fits into a round wall, as into a hole, it touches it on more than one side:
/// points at right angles and opposite to the nearest one, at the same place of the meridian.
void add_other_sides(const WallView& view, const Beside& beside, const NearestPlace& near,
                     std::vector<ContactPoint>& points) {
    const BesideAxis foot = beside.at - near.distance * near.normal;
    const double radius = view.bodies.radius[view.body];
    const Vec3 sideways = cross(beside.axis, beside.outwards);
    const Vec3 others[] = {sideways, -sideways, -beside.outwards};
    std::int32_t feature = near.end + 1;
    for (const Vec3& outwards : others) {
        feature += features_of_a_place;
        // From the same circle of the surface, in another direction from the axis, to the centre.
        const Vec3 offset = beside.at.radius * beside.outwards - foot.radius * outwards +
                            (beside.at.height - foot.height) * beside.axis;
        const double distance = norm(offset), gap = distance - radius;
        if (distance > 0.0 && gap < view.alert)
            add_point(view, (1.0 / distance) * offset, gap, feature, points);
    }
}

/// From the centre to the opposite side of a round wall.
bool may_fit(const WallView& view, const Beside& beside, const NearestPlace& near) {
    const BesideAxis foot = beside.at - near.distance * near.normal;
    // Only from inside, where the normal points to the axis. The far side is at least rho +
    // rho_foot away.
    return foot.radius > 0.0 && near.normal.radius < 0.0 &&
           beside.at.radius + foot.radius - view.bodies.radius[view.body] < view.alert;
}

void sphere_round(const WallView& view, std::vector<ContactPoint>& points) {
    const Beside beside(view.wall, view.bodies.position[view.body]);
    const NearestPlace near = nearest_place(view.wall.meridian, beside.at);
    const double gap = near.distance - view.bodies.radius[view.body];
    if (!(gap < view.alert)) return;
    if (near.end >= 0 && view.placed &&
        !view.placed->joints.is_nearest(view.wall_index, static_cast<std::size_t>(near.end),
                                        near.distance * near.normal))
        return;
    add_point(view, beside.direction(near.normal), gap, near.end + 1, points);
    if (may_fit(view, beside, near)) add_other_sides(view, beside, near, points);
}

void sphere_rectangle(const WallView& view, std::vector<ContactPoint>& points) {
    const Wall& wall = view.wall;
    const Vec3 arm = view.bodies.position[view.body] - wall.point;
    const Vec3 across = cross(wall.normal, wall.side);
    // The nearest place of a rectangle is the centre with x and y clamped to it.
    const double x = dot(wall.side, arm), y = dot(across, arm), height = dot(wall.normal, arm);
    const double beyond_x = x - std::clamp(x, -wall.half_length, wall.half_length);
    const double beyond_y = y - std::clamp(y, -wall.half_width, wall.half_width);
    const bool inside = beyond_x == 0.0 && beyond_y == 0.0;
    const Vec3 offset = beyond_x * wall.side + beyond_y * across + height * wall.normal;
    const double distance = inside ? std::abs(height) : norm(offset);
    const double gap = distance - view.bodies.radius[view.body];
    if (!(gap < view.alert)) return;
    // A centre above the rectangle is held on its side; beside it the contact is with an edge or
    // corner.
    if (!inside && view.placed &&
        !view.placed->rectangles.is_nearest(view.wall_index,
                                            view.bodies.position[view.body] - offset, offset))
        return;
    const Vec3 normal =
        inside ? (height < 0.0 ? -1.0 : 1.0) * wall.normal : (1.0 / distance) * offset;
    add_point(view, normal, gap, inside ? 0 : 1, points);
}

}  // namespace

void check_space_wall(const Wall& wall) {
    if (wall.form == WallForm::flat && has_ends(wall))
        throw std::invalid_argument("wall " + std::to_string(wall.key) +
                                    ": half_length = " + std::to_string(wall.half_length) +
                                    ": segments are of the plane; a flat wall of spheres with ends "
                                    "is a rectangle, and one without has an infinite length");
}

void sphere_wall(const WallView& view, std::vector<ContactPoint>& points) {
    switch (view.wall.form) {
        case WallForm::flat:
            return round_half_space(view, points);
        case WallForm::rectangle:
            return sphere_rectangle(view, points);
        case WallForm::round:
            return sphere_round(view, points);
    }
}

}  // namespace turbidite::nscd
