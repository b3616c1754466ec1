// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/walls.hpp"

#include <stdexcept>
#include <string>

#include "granular_adapter/nscd/vec3.hpp"

namespace turbidite::nscd {

double signed_distance(const Wall& wall, const Vec3& point) {
    return dot(wall.normal, point - wall.point);
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
}

}  // namespace turbidite::nscd
