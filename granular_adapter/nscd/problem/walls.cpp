// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/problem/walls.hpp"

#include <stdexcept>
#include <string>

#include "granular_adapter/nscd/problem/vec3.hpp"

namespace turbidite::nscd {

double signed_distance(const Wall& wall, const Vec3& point) {
    return dot(wall.normal, point - wall.point);
}

bool is_moving(const Wall& wall) {
    return norm(wall.velocity) > 0.0 || wall.spin != 0.0;
}

Vec3 velocity_at(const Wall& wall, const Vec3& place) {
    return wall.velocity + cross({0.0, 0.0, wall.spin}, place - wall.pivot);
}

void move(Wall& wall, double step) {
    const double c = std::cos(step * wall.spin), s = std::sin(step * wall.spin);
    const Vec3 arm = wall.point - wall.pivot, normal = wall.normal;
    wall.pivot = wall.pivot + step * wall.velocity;
    if (wall.spin == 0.0) {
        wall.point = wall.point + step * wall.velocity;
        return;
    }
    wall.point = wall.pivot + Vec3{c * arm[0] - s * arm[1], s * arm[0] + c * arm[1], arm[2]};
    wall.normal = {c * normal[0] - s * normal[1], s * normal[0] + c * normal[1], 0.0};
    wall.normal = (1.0 / norm(wall.normal)) * wall.normal;
}

double along(const Wall& wall, const Vec3& point) {
    const Vec3 tangent{-wall.normal[1], wall.normal[0], 0.0};
    return dot(tangent, point - wall.point);
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
    if (!is_finite(wall.velocity) || !is_finite(wall.pivot) || !std::isfinite(wall.spin))
        throw std::invalid_argument(name + "its motion must be finite");
    if (wall.velocity[2] != 0.0) throw std::invalid_argument(name + "it must move in the plane");
}

}  // namespace turbidite::nscd
