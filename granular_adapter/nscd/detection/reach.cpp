// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/detection/reach.hpp"

#include <algorithm>
#include <cmath>

#include "coupler/rigid/vec3.hpp"

namespace turbidite::nscd {
namespace {

/// Upper bound of |u_rel| between any two bodies, or a body and a wall: the diagonal of the
/// bounding box of all velocities and zero.
double speed_range(const std::vector<Twist>& twists) {
    // Both start at zero: bodies may also meet walls at rest.
    Vec3 low{}, high{};
    for (const Twist& twist : twists)
        for (int axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], twist.velocity[axis]);
            high[axis] = std::max(high[axis], twist.velocity[axis]);
        }
    return norm(high - low);
}

/// No place of a wall with ends is farther from its point than this.
double farthest_end(const Wall& wall) {
    if (wall.form == WallForm::flat) return wall.half_length + wall.half_thickness;
    if (wall.form == WallForm::rectangle)
        return std::hypot(wall.half_length, wall.half_width) + wall.half_thickness;
    const auto& [p, q] = wall.meridian;
    return std::max(norm(p), norm(q)) + wall.half_thickness;
}

/// A round wall that turns about its own axis stays where it is.
bool turns_in_place(const Wall& wall) {
    const auto along = [&](const Vec3& x) {
        return norm(cross(wall.normal, x)) <= 1e-12 * norm(x);
    };
    return wall.form == WallForm::round && along(wall.twist.spin) && along(wall.point - wall.pivot);
}

/// Bound of the speed of a turning wall with ends: that of its fastest end.
double end_speed(const Wall& wall) {
    if (turns_in_place(wall)) return norm(wall.twist.velocity);
    const double arm = norm(wall.point - wall.pivot) + farthest_end(wall);
    return norm(wall.twist.velocity) + norm(wall.twist.spin) * arm;
}

/// Largest speed of a wall where it may touch a body.
double wall_speed(const std::vector<Wall>& walls, const Bodies& bodies) {
    double fastest = 0.0;
    for (const Wall& wall : walls) {
        fastest = std::max(fastest, norm(wall.twist.velocity));
        if (wall.twist.spin == Vec3{}) continue;
        if (has_ends(wall)) {
            fastest = std::max(fastest, end_speed(wall));
            continue;
        }
        // A half-space has no farthest point, but it acts only where a body is. Within its radius R
        // of the centre x, |v| <= |v(x)| + |spin| R.
        for (std::size_t i = 0; i < bodies.size(); ++i)
            fastest = std::max(fastest, norm(velocity_at(wall, bodies.position[i])) +
                                            norm(wall.twist.spin) * bodies.radius[i]);
    }
    return fastest;
}

}  // namespace

double corner_speed(const Bodies& bodies, const std::vector<Twist>& twists) {
    double fastest = 0.0;
    for (std::size_t i = 0; i < twists.size(); ++i)
        fastest = std::max(fastest, bodies.radius[i] * norm(twists[i].spin));
    return fastest;
}

double approach_bound(const Bodies& bodies, const std::vector<Wall>& walls,
                      const std::vector<Twist>& twists, double corners, double step) {
    // dt (|v_b - v_a| + R_a |omega_a| + R_b |omega_b| + |v_wall|), each at its largest. A round
    // body presents the same surface however it turns, so its spin does not count.
    const double speed = speed_range(twists) + 2.0 * corners;
    return step * (speed + wall_speed(walls, bodies));
}

}  // namespace turbidite::nscd
