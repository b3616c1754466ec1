// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/soft/point_force.hpp"

#include <algorithm>
#include <cmath>

#include "coupler/rigid/vec3.hpp"

namespace turbidite::soft {
namespace {

/// Of b, as seen from a or from a wall at rest.
Vec3 relative_velocity(const nscd::ContactPoint& point, const nscd::Bodies& bodies) {
    const Vec3 of_b = bodies.twist[point.b].at(point.arm_b);
    return point.wall < 0 ? of_b - bodies.twist[point.a].at(point.arm_a) : of_b;
}

}  // namespace

PointForce point_force(const SoftLaw& law, const Overlap& overlap, const nscd::Bodies& bodies,
                       double step, double& slip) {
    const Vec3& normal = overlap.point.normal;
    const Vec3 tangent{-normal[1], normal[0], 0.0};
    const Vec3 velocity = relative_velocity(overlap.point, bodies);
    const double spring = overlap.mass * law.frequency * law.frequency;       // k = m w^2
    const double dashpot = 2.0 * law.damping * overlap.mass * law.frequency;  // c = 2 zeta m w
    const double push =
        std::max(0.0, -spring * overlap.point.gap - dashpot * dot(velocity, normal));
    const double along = dot(velocity, tangent);
    slip += step * along;
    const double wanted = -tangential_share * (spring * slip + dashpot * along);
    const double limit = law.friction * push;
    if (std::abs(wanted) < limit) return {push * normal + wanted * tangent, push > 0.0, false};
    const double friction = std::copysign(limit, wanted);
    slip = -(friction / tangential_share + dashpot * along) / spring;  // T(slip) = friction
    return {push * normal + friction * tangent, push > 0.0, push > 0.0};
}

}  // namespace turbidite::soft
