// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/detection/space/rectangle_joints.hpp"

#include <algorithm>

#include "granular_adapter/nscd/detection/wall_ends.hpp"

namespace turbidite::nscd {
namespace {

bool is_rectangle(const Wall& wall) {
    return wall.form == WallForm::rectangle;
}

/// Whether a rectangle may end on another wall.
bool may_meet(const Wall& own, const Wall& other) {
    return is_rectangle(own) && other.form != WallForm::round && may_end_on(own, other);
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
                others_[i].push_back({walls[j], rounding_on(walls[i], walls[j])});
}

bool RectangleJoints::is_nearest(std::int32_t wall, const Vec3& place, const Vec3& offset) const {
    if (others_.empty()) return true;
    const auto& others = others_[static_cast<std::size_t>(wall)];
    return std::none_of(others.begin(), others.end(), [&](const Other& other) {
        if (!is_on(other.wall, place, other.rounding)) return false;
        const Vec3 way = nearest_place(other.wall, place + offset) - place;
        return norm(way) > other.rounding &&
               dot(way, offset) > leads_nearer * norm(way) * norm(offset);
    });
}

}  // namespace turbidite::nscd
