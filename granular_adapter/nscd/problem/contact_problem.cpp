// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/problem/contact_problem.hpp"

namespace turbidite::nscd {

Vec3 tangent_of(const Vec3& normal) {
    const Vec3 t{-normal[1], normal[0], 0.0};
    if (normal[2] == 0.0) return t;  // as long as n, without rounding
    const double length = norm(t);
    return length > 0.0 ? (1.0 / length) * t : Vec3{1.0, 0.0, 0.0};
}

namespace {

/// How much a unit impulse along the normal, at the end of the arm, moves that point along it.
template <class Mobility>
double moved(const Mobility& body, const Vec3& arm, const Vec3& normal) {
    Twist twist;
    push(twist, body, arm, normal, 0.0);
    return dot(normal, twist.at(arm));
}

}  // namespace

double normal_mobility(const Mobilities& mobilities, const Contact& c) {
    return std::visit(
        [&](const auto& bodies) {
            const double b = moved(bodies[static_cast<std::size_t>(c.b)], c.arm_b, c.normal);
            return c.a < 0 ? b
                           : b + moved(bodies[static_cast<std::size_t>(c.a)], c.arm_a, c.normal);
        },
        mobilities);
}

std::vector<Twist> body_velocities(const ContactProblem& problem, const Impulses& r) {
    return std::visit([&](const auto& bodies) { return body_velocities(problem, bodies, r); },
                      problem.bodies);
}

}  // namespace turbidite::nscd
