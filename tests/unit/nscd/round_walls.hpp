// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Round walls and rectangles for tests.
#pragma once

#include "spheres.hpp"

namespace turbidite::nscd::scenes {

/// The meridian from (r1, h1) to (r2, h2) about an axis through `base`.
inline Wall round_wall(std::int32_t key, const Vec3& base, const Vec3& axis, BesideAxis from,
                       BesideAxis to, double friction = 0.0) {
    Wall result = wall(key, base, (1.0 / norm(axis)) * axis, friction);
    result.form = WallForm::round;
    result.meridian = {from, to};
    result.pivot = base;
    return result;
}

/// Around z, from z = -length/2 to length/2.
inline Wall tube(double radius, double length, double friction = 0.0, std::int32_t key = 6) {
    return round_wall(key, {}, {0, 0, 1}, {radius, -0.5 * length}, {radius, 0.5 * length},
                      friction);
}

inline Wall rectangle(std::int32_t key, const Vec3& middle, const Vec3& normal, const Vec3& side,
                      double half_length, double half_width, double friction = 0.0) {
    Wall result = wall(key, middle, normal, friction);
    result.form = WallForm::rectangle;
    result.side = side;
    result.half_length = half_length;
    result.half_width = half_width;
    result.pivot = middle;
    return result;
}

}  // namespace turbidite::nscd::scenes
