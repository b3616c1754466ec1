// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/problem/contact_problem.hpp"

#include "coupler/rigid/vec3.hpp"

namespace turbidite::nscd {
namespace {

/// Adds the change of velocity by an impulse p at the end of `arm` and a moment impulse m.
void push(Twist& twist, const BodyMobility& body, const Vec3& arm, const Vec3& p, double m) {
    const PlanarVector change = body * PlanarVector{p[0], p[1], cross_z(arm, p) + m};
    twist.velocity[0] += change.x;
    twist.velocity[1] += change.y;
    twist.spin[2] += change.spin;
}

}  // namespace

Vec3 tangent_of(const Vec3& normal) {
    return {-normal[1], normal[0], 0.0};
}

ContactVector contact_velocity(const Contact& contact, const std::vector<Twist>& v) {
    const Twist& b = v[static_cast<std::size_t>(contact.b)];
    // v_b + w_b x arm_b - (v_a + w_a x arm_a)
    double x = b.velocity[0] - b.spin[2] * contact.arm_b[1];
    double y = b.velocity[1] + b.spin[2] * contact.arm_b[0];
    double spin = b.spin[2];
    if (contact.a >= 0) {
        const Twist& a = v[static_cast<std::size_t>(contact.a)];
        x -= a.velocity[0] - a.spin[2] * contact.arm_a[1];
        y -= a.velocity[1] + a.spin[2] * contact.arm_a[0];
        spin -= a.spin[2];
    }
    const Vec3 &n = contact.normal, &t = contact.tangent;
    return in_plane(n[0] * x + n[1] * y, t[0] * x + t[1] * y, spin);
}

Vec3 world_impulse(const Contact& contact, const ContactVector& r) {
    return r.n * contact.normal + r.t * contact.tangent;
}

std::vector<Twist> body_velocities(const ContactProblem& problem, const Impulses& r) {
    std::vector<Twist> v = problem.free;
    for (std::size_t k = 0; k < r.size(); ++k) {
        if (r[k] == ContactVector{}) continue;
        const Contact& contact = problem.contacts[k];
        const Vec3 p = world_impulse(contact, r[k]);
        push(v[contact.b], problem.bodies[contact.b], contact.arm_b, p, r[k].roll);
        if (contact.a >= 0)
            push(v[contact.a], problem.bodies[contact.a], contact.arm_a, -1.0 * p, -r[k].roll);
    }
    return v;
}

}  // namespace turbidite::nscd
