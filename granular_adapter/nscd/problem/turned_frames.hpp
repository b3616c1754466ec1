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

inline Impulses in_world_axes(const ContactProblem& problem, const Impulses& r) {
    Impulses kept;
    kept.reserve(r.size());
    for (std::size_t k = 0; k < r.size(); ++k)
        kept.push_back(in_world_axes(problem.contacts[k], r[k]));
    return kept;
}

inline Impulses from_world_axes(const ContactProblem& problem, const Impulses& kept) {
    Impulses r;
    r.reserve(kept.size());
    for (std::size_t k = 0; k < kept.size(); ++k)
        r.push_back(from_world_axes(problem.contacts[k], kept[k]));
    return r;
}

}  // namespace turbidite::nscd
