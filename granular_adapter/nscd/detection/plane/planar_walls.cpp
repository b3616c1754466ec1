// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/detection/plane/planar_walls.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include "granular_adapter/nscd/detection/narrow_phase.hpp"
#include "granular_adapter/nscd/detection/round_contacts.hpp"

namespace turbidite::nscd {
namespace {

Vec3 tangent_of(const Wall& wall) {
    // t = e_z x n
    return {-wall.normal[1], wall.normal[0], 0.0};
}

/// Beyond the end of a segment the contact is with its corner.
void disc_corner(const WallView& view, double end, std::vector<ContactPoint>& points) {
    const Vec3 tangent = tangent_of(view.wall);
    const Vec3 corner = view.wall.point + end * tangent;
    const Vec3 offset = view.bodies.position[view.body] - corner;
    const double distance = norm(offset), radius = view.bodies.radius[view.body];
    if (!(distance - radius < view.alert)) return;
    // A disc whose centre is the corner may leave along the wall.
    const Vec3 normal =
        distance > 0.0 ? (1.0 / distance) * offset : std::copysign(1.0, end) * tangent;
    if (view.placed && !view.placed->plates.is_nearest(view.wall_index, end > 0.0, normal)) return;
    // Features: 0 the side, 1 and 2 its ends.
    points.push_back({-1, view.body, view.wall_index, end > 0.0 ? 1 : 2, distance - radius, normal,
                      Vec3{}, -radius * normal});
}

void disc_segment(const WallView& view, std::vector<ContactPoint>& points) {
    const Vec3& centre = view.bodies.position[view.body];
    const double place = dot(tangent_of(view.wall), centre - view.wall.point);
    const double end = view.wall.half_length, radius = view.bodies.radius[view.body];
    if (std::abs(place) > end) return disc_corner(view, std::copysign(end, place), points);
    // A segment holds grains on both sides.
    const double height = signed_distance(view.wall, centre), side = height < 0.0 ? -1.0 : 1.0;
    const double gap = side * height - radius;
    if (!(gap < view.alert)) return;
    const Vec3 normal = side * view.wall.normal;
    points.push_back({-1, view.body, view.wall_index, 0, gap, normal, Vec3{}, -radius * normal});
}

}  // namespace

void check_planar(const Wall& wall) {
    if (wall.form != WallForm::flat)
        throw std::invalid_argument("wall " + std::to_string(wall.key) +
                                    ": in the plane walls are half-planes and segments");
    const auto& [velocity, spin] = wall.twist;
    if (velocity[2] != 0.0 || spin[0] != 0.0 || spin[1] != 0.0)
        throw std::invalid_argument("wall " + std::to_string(wall.key) +
                                    ": it must move in the plane");
}

void disc_wall(const WallView& view, std::vector<ContactPoint>& points) {
    if (std::isfinite(view.wall.half_length))
        disc_segment(view, points);
    else
        round_half_space(view, points);
}

}  // namespace turbidite::nscd
