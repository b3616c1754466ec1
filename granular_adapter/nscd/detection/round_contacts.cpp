// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/detection/round_contacts.hpp"

namespace turbidite::nscd {

void round_round(const PairView& view, std::vector<ContactPoint>& points) {
    const double radius_a = view.bodies.radius[view.a], radius_b = view.bodies.radius[view.b];
    const double distance = norm(view.offset);
    // g = |x_b - x_a| - r_a - r_b
    const double gap = distance - radius_a - radius_b;
    if (!(gap < view.alert)) return;
    // Concentric bodies have no normal; any direction separates them.
    const Vec3 normal = distance > 0.0 ? (1.0 / distance) * view.offset : Vec3{1.0, 0.0, 0.0};
    // Both arms end in the middle of the gap, so that impulse and reaction have no net moment:
    // arm_a - arm_b = (r_a + r_b + g) n = x_b - x_a.
    const Vec3 arm_a = (radius_a + 0.5 * gap) * normal;
    const Vec3 arm_b = (-radius_b - 0.5 * gap) * normal;
    points.push_back({view.a, view.b, -1, 0, gap, normal, arm_a, arm_b});
}

void round_half_space(const WallView& view, std::vector<ContactPoint>& points) {
    const double radius = view.bodies.radius[view.body];
    const double gap = signed_distance(view.wall, view.bodies.position[view.body]) - radius;
    if (!(gap < view.alert)) return;
    const Vec3& normal = view.wall.normal;
    points.push_back({-1, view.body, view.wall_index, 0, gap, normal, Vec3{}, -radius * normal});
}

}  // namespace turbidite::nscd
