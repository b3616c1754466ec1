// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/detection/space/rectangle_joints.hpp"

#include <algorithm>
#include <cmath>

#include "coupler/rigid/vec3.hpp"

namespace turbidite::nscd {
namespace {

// Of the size of the larger rectangle: rounding of places on it.
constexpr double on_a_rectangle = 1e-9;

// Cosine above which a rectangle leads nearer to a centre: two points for one where it just does,
// so that rounding never leaves none.
constexpr double nearer_along = 1e-9;

bool is_rectangle(const Wall& wall) {
    return wall.form == WallForm::rectangle;
}

double half_diagonal(const Wall& wall) {
    return std::hypot(wall.half_length, wall.half_width);
}

/// Of a half-space there is no size.
double tolerance(const Wall& one, const Wall& other) {
    return on_a_rectangle *
           (is_rectangle(other) ? std::max(size_of(one), size_of(other)) : size_of(one));
}

/// Whether a rectangle may end on another wall, which covers its edge.
bool may_meet(const Wall& own, const Wall& other) {
    if (!is_rectangle(own) || other.form == WallForm::round) return false;
    const double rounding = tolerance(own, other);
    if (own.half_thickness > other.half_thickness + rounding) return false;
    return !is_rectangle(other) ||
           norm(other.point - own.point) <= half_diagonal(own) + half_diagonal(other) + rounding;
}

/// The place of a rectangle or half-space that is nearest to a point.
Vec3 nearest_place(const Wall& wall, const Vec3& x) {
    if (!is_rectangle(wall)) return x - signed_distance(wall, x) * wall.normal;
    const Vec3 arm = x - wall.point, across = cross(wall.normal, wall.side);
    return wall.point +
           std::clamp(dot(wall.side, arm), -wall.half_length, wall.half_length) * wall.side +
           std::clamp(dot(across, arm), -wall.half_width, wall.half_width) * across;
}

}  // namespace

RectangleJoints::RectangleJoints(const std::vector<Wall>& walls) {
    if (std::none_of(walls.begin(), walls.end(), is_rectangle)) return;
    others_.resize(walls.size());
    for (std::size_t i = 0; i < walls.size(); ++i)
        for (std::size_t j = 0; j < walls.size(); ++j)
            if (i != j && may_meet(walls[i], walls[j]))
                others_[i].push_back({walls[j], tolerance(walls[i], walls[j])});
}

bool RectangleJoints::is_nearest(std::int32_t wall, const Vec3& place, const Vec3& offset) const {
    if (others_.empty()) return true;
    const auto& others = others_[static_cast<std::size_t>(wall)];
    return std::none_of(others.begin(), others.end(), [&](const Other& other) {
        if (!is_on(other.wall, place, other.rounding)) return false;
        const Vec3 way = nearest_place(other.wall, place + offset) - place;
        return norm(way) > other.rounding &&
               dot(way, offset) > nearer_along * norm(way) * norm(offset);
    });
}

}  // namespace turbidite::nscd
