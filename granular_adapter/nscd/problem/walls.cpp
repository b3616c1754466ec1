// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/problem/walls.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "coupler/rigid/rotation.hpp"

namespace turbidite::nscd {
namespace {

/// Of a wall of space that is not a half-space.
WallSurface surface_of(const Wall& wall) {
    return {wall.form == WallForm::round,
            wall.point,
            wall.normal,
            wall.meridian,
            wall.side,
            wall.half_length,
            wall.half_width};
}

void check_rectangle(const Wall& wall, const std::string& name) {
    if (!(std::isfinite(wall.half_length) && wall.half_width > 0.0))
        throw std::invalid_argument(name + "the edges of a rectangle must be longer than zero");
    if (!(std::abs(norm(wall.side) - 1.0) < 1e-9 && std::abs(dot(wall.side, wall.normal)) < 1e-9))
        throw std::invalid_argument(name +
                                    "the side of a rectangle must have length 1 and be normal to "
                                    "its normal");
}

void check_meridian(const Wall& wall, const std::string& name) {
    const auto& [p, q] = wall.meridian;
    if (!(p.radius >= 0.0 && q.radius >= 0.0))
        throw std::invalid_argument(name + "its radii must be zero or positive");
    const double length = norm(q - p);
    if (!(length > 0.0 && std::isfinite(length)) || !(p.radius + q.radius > 0.0))
        throw std::invalid_argument(name + "its two rims must be apart and not both on its axis");
}

}  // namespace

bool has_ends(const Wall& wall) {
    return wall.form != WallForm::flat || std::isfinite(wall.half_length);
}

Extent extent_of(const Wall& wall) {
    if (wall.form != WallForm::flat)
        return turbidite::extent_of(surface_of(wall), wall.half_thickness);
    Extent all;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        // A segment is along e_z x n = (-n_y, n_x): L |n_y| along x, L |n_x| along y.
        const double along = axis < 2 ? std::abs(wall.normal[1 - axis]) * wall.half_length : 0.0;
        const double half = along + wall.half_thickness;
        all.low[axis] = wall.point[axis] - half;
        all.high[axis] = wall.point[axis] + half;
    }
    return all;
}

double size_of(const Wall& wall) {
    if (wall.form != WallForm::round) return 2.0 * std::max(wall.half_length, wall.half_width);
    const auto& [p, q] = wall.meridian;
    return std::max({p.radius, q.radius, std::abs(q.height - p.height)});
}

bool is_on(const Wall& wall, const Vec3& place, double tolerance) {
    const Vec3 arm = place - wall.point;
    const double height = dot(wall.normal, arm);
    if (wall.form == WallForm::round)
        return nearest_place(wall.meridian, {norm(arm - height * wall.normal), height}).distance <=
               tolerance;
    // A segment is along e_z x n = (-n_y, n_x).
    const bool flat = wall.form == WallForm::flat;
    const Vec3 side = flat ? Vec3{-wall.normal[1], wall.normal[0], 0.0} : wall.side;
    const double across = flat ? 0.0 : dot(cross(wall.normal, side), arm);
    return std::abs(height) <= tolerance &&
           std::abs(dot(side, arm)) <= wall.half_length + tolerance &&
           std::abs(across) <= wall.half_width + tolerance;
}

double signed_distance(const Wall& wall, const Vec3& point) {
    // n . (x - p)
    return dot(wall.normal, point - wall.point);
}

bool is_moving(const Wall& wall) {
    return !wall.twist.at_rest();
}

Vec3 velocity_at(const Wall& wall, const Vec3& place) {
    // v(x) = velocity + spin x (x - pivot)
    return wall.twist.at(place - wall.pivot);
}

void move(Wall& wall, double step) {
    // The arm from the pivot turns by dt spin, and the pivot moves by dt velocity.
    const Vec3 arm = wall.point - wall.pivot;
    const Shift shift = step * wall.twist;
    wall.pivot = wall.pivot + shift.displacement;
    if (wall.twist.spin == Vec3{}) {
        wall.point = wall.point + shift.displacement;
        return;
    }
    const Rotation turn = rotation(shift.angle);
    wall.point = wall.pivot + turn(arm);
    wall.normal = turn(wall.normal);
    // Keeps the rounding of many steps from changing its length.
    wall.normal = (1.0 / norm(wall.normal)) * wall.normal;
    if (wall.form == WallForm::rectangle) wall.side = turn(wall.side);
}

void check_wall(const Wall& wall) {
    const std::string name = "wall " + std::to_string(wall.key) + ": ";
    if (!(std::abs(norm(wall.normal) - 1.0) < 1e-9))
        throw std::invalid_argument(name + "the normal must have length 1");
    if (!(wall.friction >= 0.0))
        throw std::invalid_argument(name + "friction must be zero or positive");
    if (!(wall.half_length > 0.0))
        throw std::invalid_argument(name + "the half length must be positive");
    if (!(wall.half_thickness >= 0.0))
        throw std::invalid_argument(name + "the half thickness must be zero or positive");
    if (wall.form == WallForm::rectangle) check_rectangle(wall, name);
    if (wall.form == WallForm::round) check_meridian(wall, name);
    const auto& [velocity, spin] = wall.twist;
    if (!is_finite(velocity) || !is_finite(wall.pivot) || !is_finite(spin))
        throw std::invalid_argument(name + "its motion must be finite");
}

}  // namespace turbidite::nscd
