// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The exact solution of Signorini-Coulomb for one contact of spheres: given b (the velocity without
// this contact's impulse), find r with u = W r + b and
//
//     0 <= u_n perp r_n >= 0,   |r_t| <= mu r_n,   r_t = -mu r_n u_t/|u_t| unless u_t = 0.
//
// Both arms are along the normal, so W = diag(W_nn, W_tt, W_tt): normal and tangential directions
// are uncoupled, and both tangents are alike.
//
//     r_n = max(0, -b_n/W_nn),   r_t = -b_t/W_tt, shortened to mu r_n where it is longer
//
// With a film r_n is that of film.hpp, and the limit mu times what the contact carries of it.
#pragma once

#include <algorithm>
#include <cmath>

#include "granular_adapter/nscd/problem/contact_vector.hpp"
#include "granular_adapter/nscd/problem/film.hpp"

namespace turbidite::nscd {

/// Diagonal block of W [1/kg], and W_rr = 1/I_a + 1/I_b of moments [1/(kg m2)].
struct SphereBlock {
    double nn = 0.0;
    double tt = 0.0;
    double rr = 0.0;
    const Film* film = nullptr;  ///< none: the contact has no film
};

/// The tangential part of x, not longer than `most`.
inline ContactVector clipped(const ContactVector& x, double most) {
    const double size = std::sqrt(x.t * x.t + x.s * x.s);
    const double factor = size > most ? most / size : 1.0;
    return {0.0, factor * x.t, factor * x.s, 0.0};
}

/// The normal part; without a film all of it is the contact's.
inline FilmedNormal solve_normal(const SphereBlock& w, double b) {
    if (w.film) return solve_film(*w.film, w.nn, b);
    const double n = std::max(0.0, -b / w.nn);
    return {n, n};
}

/// r with u = W r + b that solves the contact.
inline ContactVector solve_contact(const SphereBlock& w, const ContactVector& b, double friction) {
    const FilmedNormal n = solve_normal(w, b.n);
    ContactVector r = clipped((-1.0 / w.tt) * b, friction * n.contact);
    r.n = n.impulse;
    return r;
}

/// The point of the cone |t| <= mu n closest to x. On the edge n = (x_n + mu |x_t|)/(1 + mu^2),
/// which is larger than x_n exactly where x is outside.
inline ContactVector project_on_cone(const ContactVector& x, double friction) {
    const double t = std::sqrt(x.t * x.t + x.s * x.s);
    const double n = std::max({0.0, x.n, (x.n + friction * t) / (1.0 + friction * friction)});
    ContactVector nearest = clipped(x, friction * n);
    nearest.n = n;
    return nearest;
}

/// r - P_K(r - rho (u + (mu |u_t|, 0))), P_K the projection on the friction cone K: zero exactly at
/// a solution [N s].
inline ContactVector natural_map(const ContactVector& r, const ContactVector& u, double friction,
                                 double rho) {
    const double slip = std::sqrt(u.t * u.t + u.s * u.s);
    const ContactVector target{r.n - rho * (u.n + friction * slip), r.t - rho * u.t,
                               r.s - rho * u.s, 0.0};
    const ContactVector nearest = project_on_cone(target, friction);
    return {r.n - nearest.n, r.t - nearest.t, r.s - nearest.s, 0.0};
}

}  // namespace turbidite::nscd
