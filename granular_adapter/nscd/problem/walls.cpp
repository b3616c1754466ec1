// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/problem/walls.hpp"

#include <stdexcept>
#include <string>

#include "coupler/rigid/rotation.hpp"

namespace turbidite::nscd {

double signed_distance(const Wall& wall, const Vec3& point) {
    return dot(wall.normal, point - wall.point);
}

bool is_moving(const Wall& wall) {
    return !wall.twist.at_rest();
}

Vec3 velocity_at(const Wall& wall, const Vec3& place) {
    return wall.twist.at(place - wall.pivot);
}

void move(Wall& wall, double step) {
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
    wall.normal = (1.0 / norm(wall.normal)) * wall.normal;
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
    const auto& [velocity, spin] = wall.twist;
    if (!is_finite(velocity) || !is_finite(wall.pivot) || !is_finite(spin))
        throw std::invalid_argument(name + "its motion must be finite");
}

}  // namespace turbidite::nscd
