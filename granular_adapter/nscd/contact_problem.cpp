// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/contact_problem.hpp"

#include "granular_adapter/nscd/vec3.hpp"

namespace turbidite::nscd {
namespace {

Vec3 point_velocity(const Twist& twist, const Vec3& arm) {
    return twist.velocity + cross(twist.spin, arm);
}

/// Impulse p at the end of `arm` and moment impulse m.
void push(Twist& twist, const BodyMobility& body, const Vec3& arm, const Vec3& p, double m) {
    const PlanarVector change = body * PlanarVector{p[0], p[1], cross(arm, p)[2] + m};
    twist.velocity[0] += change.x;
    twist.velocity[1] += change.y;
    twist.spin[2] += change.spin;
}

}  // namespace

Vec3 tangent_of(const Vec3& normal) {
    return {-normal[1], normal[0], 0.0};
}

Vec3 contact_velocity(const Contact& contact, const std::vector<Twist>& v) {
    Vec3 relative = point_velocity(v[contact.b], contact.arm_b);
    double spin = v[contact.b].spin[2];
    if (contact.a >= 0) {
        relative = relative - point_velocity(v[contact.a], contact.arm_a);
        spin -= v[contact.a].spin[2];
    }
    return {dot(contact.normal, relative), dot(contact.tangent, relative), spin};
}

Vec3 world_impulse(const Contact& contact, const Vec3& r) {
    return r[0] * contact.normal + r[1] * contact.tangent;
}

std::vector<Twist> body_velocities(const ContactProblem& problem, const Impulses& r) {
    std::vector<Twist> v = problem.free;
    for (std::size_t k = 0; k < r.size(); ++k) {
        const Contact& contact = problem.contacts[k];
        const Vec3 p = world_impulse(contact, r[k]);
        push(v[contact.b], problem.bodies[contact.b], contact.arm_b, p, r[k][2]);
        if (contact.a >= 0)
            push(v[contact.a], problem.bodies[contact.a], contact.arm_a, -1.0 * p, -r[k][2]);
    }
    return v;
}

}  // namespace turbidite::nscd
