// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/detection/plane/plate_joints.hpp"

#include <algorithm>

#include "granular_adapter/nscd/detection/wall_ends.hpp"

namespace turbidite::nscd {
namespace {

bool is_plate(const Wall& wall) {
    return wall.form == WallForm::flat && has_ends(wall);
}

/// Whether plates may end on it: a plate, or a half-plane.
bool is_planar(const Wall& wall) {
    return wall.form == WallForm::flat;
}

/// e_z x n
Vec3 along(const Wall& wall) {
    return {-wall.normal[1], wall.normal[0], 0.0};
}

/// Directions in which a plate leads on from a place on it.
void add_onward(const Wall& wall, const Vec3& place, double rounding, std::vector<Vec3>& onward) {
    const double at = dot(along(wall), place - wall.point);
    if (at < wall.half_length - rounding) onward.push_back(along(wall));
    if (at > -wall.half_length + rounding) onward.push_back(-1.0 * along(wall));
}

}  // namespace

PlateJoints::PlateJoints(const std::vector<Wall>& walls) {
    if (std::none_of(walls.begin(), walls.end(), is_plate)) return;
    onward_.resize(walls.size());
    for (std::size_t i = 0; i < walls.size(); ++i)
        for (std::size_t j = 0; j < walls.size(); ++j) {
            const Wall &own = walls[i], &other = walls[j];
            if (i == j || !is_plate(own) || !is_planar(other)) continue;
            if (!may_end_on(own, other)) continue;
            const double rounding = rounding_on(own, other);
            for (const std::size_t end : {0, 1}) {
                const double at = end == 0 ? -own.half_length : own.half_length;
                const Vec3 place = own.point + at * along(own);
                if (is_on(other, place, rounding))
                    add_onward(other, place, rounding, onward_[i][end]);
            }
        }
}

bool PlateJoints::is_nearest(std::int32_t wall, std::size_t end, const Vec3& normal) const {
    if (onward_.empty()) return true;
    const std::vector<Vec3>& onward = onward_[static_cast<std::size_t>(wall)][end];
    return std::none_of(onward.begin(), onward.end(),
                        [&](const Vec3& d) { return dot(normal, d) > leads_nearer; });
}

bool PlateJoints::is_valley(std::int32_t wall, std::size_t end, const Vec3& normal) const {
    if (onward_.empty()) return false;
    const std::vector<Vec3>& onward = onward_[static_cast<std::size_t>(wall)][end];
    return std::any_of(onward.begin(), onward.end(),
                       [&](const Vec3& d) { return dot(normal, d) > -leads_nearer; });
}

}  // namespace turbidite::nscd
