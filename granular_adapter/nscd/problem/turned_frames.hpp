// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Impulses of one step as the initial guess of the next, in space. A frame made from the normal
// alone has a singular direction, near which it turns fast or jumps, and an impulse kept in it
// would turn with it. So the tangential part is kept as a vector in world axes, {n, x, y, z} in the
// places of {n, t, s, roll}, and projected on the tangent plane of the next step.
#pragma once

#include "granular_adapter/nscd/problem/contact_problem.hpp"

namespace turbidite::nscd {

/// {r_n, r_t in world axes}.
inline ContactVector in_world_axes(const Contact& contact, const ContactVector& r) {
    const Vec3 t = r.t * contact.tangent + r.s * binormal_of(contact);
    return {r.n, t[0], t[1], t[2]};
}

/// The same impulse in the frame of a contact; what is along its normal is left out.
inline ContactVector from_world_axes(const Contact& contact, const ContactVector& kept) {
    ContactVector r = in_frame(contact, {kept.t, kept.s, kept.roll});
    r.n = kept.n;
    return r;
}

inline std::vector<ContactVector> in_world_axes(const ContactProblem& problem, const Impulses& r) {
    std::vector<ContactVector> kept;
    kept.reserve(r.size());
    for (std::size_t k = 0; k < r.size(); ++k)
        kept.push_back(in_world_axes(problem.contacts[k], r[k]));
    return kept;
}

inline Impulses from_world_axes(const ContactProblem& problem,
                                const std::vector<ContactVector>& kept) {
    Impulses r;
    r.reserve(kept.size());
    for (std::size_t k = 0; k < kept.size(); ++k)
        r.push_back(from_world_axes(problem.contacts[k], kept[k]));
    return r;
}

/// Moments in the same form, {r_n, m in world axes}.
inline std::vector<ContactVector> kept_moments(const Impulses& r) {
    std::vector<ContactVector> kept;
    kept.reserve(r.moments.size());
    for (std::size_t k = 0; k < r.moments.size(); ++k) {
        const Vec3& m = r.moments[k];
        kept.push_back({r[k].n, m[0], m[1], m[2]});
    }
    return kept;
}

inline std::vector<Vec3> moments_of(const std::vector<ContactVector>& kept) {
    std::vector<Vec3> moments;
    moments.reserve(kept.size());
    for (const ContactVector& m : kept) moments.push_back({m.t, m.s, m.roll});
    return moments;
}

}  // namespace turbidite::nscd
