// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/problem/contact_problem.hpp"

namespace turbidite::nscd {

Vec3 tangent_of(const Vec3& normal) {
    const Vec3 t{-normal[1], normal[0], 0.0};
    if (normal[2] == 0.0) return t;  // as long as n, without rounding
    const double length = norm(t);
    return length > 0.0 ? (1.0 / length) * t : Vec3{1.0, 0.0, 0.0};
}

std::vector<Twist> body_velocities(const ContactProblem& problem, const Impulses& r) {
    return std::visit([&](const auto& bodies) { return body_velocities(problem, bodies, r); },
                      problem.bodies);
}

}  // namespace turbidite::nscd
