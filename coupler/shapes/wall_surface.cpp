// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/shapes/wall_surface.hpp"

#include <algorithm>

namespace turbidite {
namespace {

Vec3 unit(const Vec3& x) {
    return (1.0 / norm(x)) * x;
}

WallSurface rectangle(const SpaceWallShape& wall) {
    WallSurface surface;
    surface.point = wall.place + 0.5 * (wall.a + wall.b);
    surface.side = unit(wall.a);
    surface.normal = unit(cross(wall.a, wall.b));
    surface.half_length = 0.5 * norm(wall.a);
    surface.half_width = 0.5 * norm(wall.b);
    return surface;
}

WallSurface round(const SpaceWallShape& wall) {
    WallSurface surface;
    surface.round = true;
    surface.point = wall.place;
    surface.normal = unit(wall.a);
    const double height = wall.kind == SpaceWallKind::ring ? 0.0 : norm(wall.a);
    const double end = wall.kind == SpaceWallKind::cylinder ? wall.radius : wall.radius2;
    // Two ends (radius, height): a cylinder has the same radius at both, a cone another one, and a
    // ring two radii at the same height.
    surface.meridian = {{{wall.radius, 0.0}, {end, height}}};
    return surface;
}

/// The nearest place of a rectangle is the point with its coordinates clamped to it.
double distance_of_rectangle(const WallSurface& surface, const Vec3& arm) {
    const Vec3 across = cross(surface.normal, surface.side);
    const auto beyond = [](double x, double half) { return x - std::clamp(x, -half, half); };
    return norm(Vec3{beyond(dot(surface.side, arm), surface.half_length),
                     beyond(dot(across, arm), surface.half_width), dot(surface.normal, arm)});
}

/// Whether a turn about the pivot leaves the surface where it is: one about its own axis.
bool keeps_place(const WallSurface& surface, const Vec3& arm, const Vec3& angle) {
    if (!surface.round) return false;
    const Vec3 beside = arm - dot(arm, surface.normal) * surface.normal;
    const double widest = std::max(surface.meridian[0].radius, surface.meridian[1].radius);
    constexpr double rounding = 1e-12;
    return norm(cross(angle, surface.normal)) <= rounding * norm(angle) &&
           norm(beside) <= rounding * (widest + norm(arm));
}

}  // namespace

bool operator==(const WallSurface& a, const WallSurface& b) {
    const auto same_ends = [](const BesideAxis& p, const BesideAxis& q) {
        return p.radius == q.radius && p.height == q.height;
    };
    return a.round == b.round && a.point == b.point && a.normal == b.normal && a.side == b.side &&
           a.half_length == b.half_length && a.half_width == b.half_width &&
           same_ends(a.meridian[0], b.meridian[0]) && same_ends(a.meridian[1], b.meridian[1]);
}

WallSurface surface_of(const SpaceWallShape& wall) {
    return wall.kind == SpaceWallKind::plate ? rectangle(wall) : round(wall);
}

double distance(const WallSurface& surface, const Vec3& point) {
    const Vec3 arm = point - surface.point;
    if (!surface.round) return distance_of_rectangle(surface, arm);
    const double height = dot(surface.normal, arm);
    return nearest_place(surface.meridian, {norm(arm - height * surface.normal), height}).distance;
}

Extent extent_of(const WallSurface& surface, double margin) {
    Extent all;
    const Vec3 across = cross(surface.normal, surface.side);
    const auto& [p, q] = surface.meridian;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double x = surface.point[axis], n = surface.normal[axis];
        if (!surface.round) {
            const double half = surface.half_length * std::abs(surface.side[axis]) +
                                surface.half_width * std::abs(across[axis]) + margin;
            all.low[axis] = x - half;
            all.high[axis] = x + half;
            continue;
        }
        // A circle of radius R about the axis n reaches R sqrt(1 - n_i^2) from its centre along
        // axis i. The surface is the convex combination of its two rims, so these give its extent.
        const double circle = std::sqrt(std::max(0.0, 1.0 - n * n));
        all.low[axis] =
            x - margin +
            std::min(p.height * n - p.radius * circle, q.height * n - q.radius * circle);
        all.high[axis] =
            x + margin +
            std::max(p.height * n + p.radius * circle, q.height * n + q.radius * circle);
    }
    return all;
}

PlacedWall place(const SpaceWall& wall, double time, double step) {
    const Shift shift = wall.motion->at(time);
    PlacedWall placed{surface_of(wall), wall.pivot + shift.displacement,
                      wall.motion->rate(time, step)};
    WallSurface& surface = placed.surface;
    const Vec3 arm = surface.point - wall.pivot;
    if (shift.angle == Vec3{} || keeps_place(surface, arm, shift.angle)) {
        // To the last digit, whatever the angle.
        surface.point = surface.point + shift.displacement;
        return placed;
    }
    const Rotation turn = rotation(shift.angle);
    surface.point = placed.pivot + turn(arm);
    surface.normal = turn(surface.normal);
    surface.side = turn(surface.side);
    return placed;
}

}  // namespace turbidite
