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

/// Spring, dashpot and normal force of one contact.
struct Pressed {
    double spring;   ///< k = m w^2
    double dashpot;  ///< c = 2 zeta m w
    double push;     ///< N
};

Pressed pressed(const SoftLaw& law, const Overlap& overlap, const Vec3& velocity) {
    const double spring = overlap.mass * law.frequency * law.frequency;
    const double dashpot = 2.0 * law.damping * overlap.mass * law.frequency;
    // v_n, negative while the surfaces approach. N = max(0, k g - c v_n) with the overlap g = -gap:
    // the dashpot does not pull.
    const double closing = dot(velocity, overlap.point.normal);
    return {spring, dashpot, std::max(0.0, -spring * overlap.point.gap - dashpot * closing)};
}

PointForce force_in_plane(const SoftLaw& law, const Overlap& overlap, const Vec3& velocity,
                          double step, double& slip) {
    const Vec3& normal = overlap.point.normal;
    const Vec3 tangent{-normal[1], normal[0], 0.0};
    const auto [spring, dashpot, push] = pressed(law, overlap, velocity);
    const double along = dot(velocity, tangent);
    slip += step * along;
    // T = -a (k s + c v_t)
    const double wanted = -law.tangential_share * (spring * slip + dashpot * along);
    const double limit = law.friction * push;
    if (std::abs(wanted) < limit) return {push * normal + wanted * tangent, push > 0.0, false};
    // Slides: |T| = mu N, and the spring is as long as that needs, s = -(T/a + c v_t)/k.
    const double friction = std::copysign(limit, wanted);
    slip = -(friction / law.tangential_share + dashpot * along) / spring;  // T(slip) = friction
    return {push * normal + friction * tangent, push > 0.0, push > 0.0};
}

/// The part of a slip in the plane across a normal, with the length that the slip had: the contact
/// has turned, the spring has not been released.
Vec3 turned_into_plane(const Vec3& slip, const Vec3& normal) {
    const Vec3 in_plane = slip - dot(slip, normal) * normal;
    const double length = norm(in_plane);
    return length > 0.0 ? (norm(slip) / length) * in_plane : Vec3{};
}

PointForce force_in_space(const SoftLaw& law, const Overlap& overlap, const Vec3& velocity,
                          double step, Vec3& slip) {
    const Vec3& normal = overlap.point.normal;
    const auto [spring, dashpot, push] = pressed(law, overlap, velocity);
    const Vec3 along = velocity - dot(velocity, normal) * normal;
    slip = turned_into_plane(slip, normal) + step * along;
    // T = -a (k s + c v_t), all of them vectors in the tangent plane
    const Vec3 wanted = -law.tangential_share * (spring * slip + dashpot * along);
    const double limit = law.friction * push, size = norm(wanted);
    if (size < limit) return {push * normal + wanted, push > 0.0, false};
    const Vec3 friction = size > 0.0 ? (limit / size) * wanted : Vec3{};
    // T(slip) = friction
    slip = (-1.0 / spring) * ((1.0 / law.tangential_share) * friction + dashpot * along);
    return {push * normal + friction, push > 0.0, push > 0.0};
}

}  // namespace

PointForce point_force(const SoftLaw& law, const Overlap& overlap, const nscd::Bodies& bodies,
                       double step, Vec3& slip) {
    const Vec3 velocity = relative_velocity(overlap.point, bodies);
    return law.in_space ? force_in_space(law, overlap, velocity, step, slip)
                        : force_in_plane(law, overlap, velocity, step, slip[0]);
}

}  // namespace turbidite::soft
