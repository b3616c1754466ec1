// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/problem/space/sphere_matrix.hpp"

#include "coupler/rigid/vec3.hpp"

namespace turbidite::nscd {

SphereCoupling& SphereCoupling::operator+=(const SphereCoupling& share) {
    for (std::size_t i = 0; i < entry.size(); ++i) entry[i] += share.entry[i];
    return *this;
}

SphereCoupling::End SphereCoupling::end_of(const Contact& contact, std::int32_t index, bool at_b) {
    const Vec3& arm = at_b ? contact.arm_b : contact.arm_a;
    const std::array<Vec3, 3> frame{contact.normal, contact.tangent, binormal_of(contact)};
    End end{index, {}, {}};
    for (int d = 0; d < 3; ++d) {
        // H_k of this body: +r acts on b, -r on a.
        end.force[d] = at_b ? frame[d] : -frame[d];
        end.moment[d] = cross(arm, end.force[d]);
    }
    return end;
}

SphereCoupling SphereCoupling::share(const SpaceMobility& body, const End& row, const End& column) {
    SphereCoupling w;
    for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i)
            w.entry[3 * j + i] = body.linear * dot(row.force[i], column.force[j]) +
                                 body.angular * dot(row.moment[i], column.moment[j]);
    return w;
}

SphereCoupling SphereCoupling::transposed(const SphereCoupling& w) {
    SphereCoupling result;
    for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i) result.entry[3 * j + i] = w.entry[3 * i + j];
    return result;
}

SphereMatrix::SphereMatrix(const ContactProblem& problem) {
    const auto& bodies = std::get<std::vector<SpaceMobility>>(problem.bodies);
    static_cast<CoupledRows<SphereCoupling>&>(*this) =
        coupled_rows<SphereCoupling>(problem, bodies);
    for (const Contact& contact : problem.contacts) {
        const auto own = [&](std::int32_t body, bool at_b) {
            const SphereCoupling::End end = SphereCoupling::end_of(contact, 0, at_b);
            return SphereCoupling::share(bodies[static_cast<std::size_t>(body)], end, end);
        };
        diagonal.push_back(own(contact.b, true));
        if (contact.a >= 0) diagonal.back() += own(contact.a, false);
    }
}

}  // namespace turbidite::nscd
