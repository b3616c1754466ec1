// SPDX-License-Identifier: LGPL-2.1-or-later
//
// How far a contact of spheres with a film is from its solution. Film and contact are no cone, so
// the measure is what one exact update of the contact alone would change, |r - r*|^2, which is zero
// exactly at a solution, as the natural map is. Moments likewise, divided by turning_length().
#pragma once

#include "granular_adapter/nscd/problem/space/turning_contact.hpp"

namespace turbidite::nscd {

/// r* of a contact alone, whose impulse is r at the velocity u.
struct FilmedUpdate {
    double impulse = 0.0;   ///< r_n* [N s]
    ContactVector contact;  ///< what the contact carries, which friction sees [N s]
};

inline FilmedUpdate filmed_update(const Contact& contact, const SphereBlock& w,
                                  const ContactVector& r, const ContactVector& u) {
    const FilmedNormal next = solve_normal(w, u.n - w.nn * r.n);
    ContactVector held =
        clipped(r - (1.0 / w.tt) * u, contact.friction * next.contact);  // r_t - u_t/W_tt
    held.n = next.contact;
    return {next.impulse, held};
}

inline ContactVector carried_part(const Contact& contact, const SphereBlock& w,
                                  const ContactVector& r, const ContactVector& u) {
    return filmed_update(contact, w, r, u).contact;
}

/// The moment of a contact alone that carries n.
inline Vec3 held_moment(const Contact& contact, const SphereBlock& w, double n,
                        const Turning& turning) {
    const auto along = [&](const Vec3& x) { return dot(contact.normal, x) * contact.normal; };
    const Vec3 wanted = turning.moment - (1.0 / w.rr) * turning.spin, twist = along(wanted);
    return clipped(wanted - twist, contact.rolling * n) + clipped(twist, contact.torsion * n);
}

/// |r - r*|^2 and |r|^2 [(N s)^2].
inline MapTerms filmed_terms(const Contact& contact, const SphereBlock& w, const ContactVector& r,
                             const ContactVector& u) {
    const auto [impulse, held] = filmed_update(contact, w, r, u);
    const double fn = r.n - impulse, ft = r.t - held.t, fs = r.s - held.s;
    return {fn * fn + ft * ft + fs * fs, r.n * r.n + r.t * r.t + r.s * r.s};
}

/// The same with moments; requires W_rr > 0.
inline MapTerms filmed_terms(const Contact& contact, const SphereBlock& w, const ContactVector& r,
                             const ContactVector& u, const Turning& turning) {
    MapTerms terms = filmed_terms(contact, w, r, u);
    const double n = filmed_update(contact, w, r, u).contact.n, shorter = 1.0 / turning_length(w);
    const Vec3 change = shorter * (turning.moment - held_moment(contact, w, n, turning));
    const Vec3 moment = shorter * turning.moment;
    terms.error += dot(change, change);
    terms.size += dot(moment, moment);
    return terms;
}

}  // namespace turbidite::nscd
