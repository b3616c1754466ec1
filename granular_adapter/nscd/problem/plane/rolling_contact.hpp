// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The exact solution for one contact with rolling resistance, in (n, t, roll): friction and rolling
// moment are both bounded by the normal impulse (contact_problem.hpp),
//
//     0 <= u_n perp r_n >= 0,   |r_t| <= mu r_n,   |m| <= rho r_n,   each opposing its velocity.
//
// For given r_n, (t, m) solves a convex problem on a box, which has one solution in closed form.
// With c(x, l) = min(l, max(-l, x)) and the moment limit M = rho r_n, the moment for a given t is
// m(t) = c(-(b_r + W_tr t)/W_rr, M), so t is the zero of
//
//     W_tt t + b_t + c(-W_tr (b_r + W_tr t)/W_rr, |W_tr| M),
//
// which is max(g_-, min(g_+, g_0)) of three increasing lines (moment at either limit, moment free).
// The zero of the larger of two increasing lines is the smaller of their zeros, and conversely.
//
// Discs have W_nt = W_nr = 0, and r_n is found first. Otherwise u_n along the solutions (t, m) of
// r_n is piecewise linear in r_n, b_n < 0 at zero and increasing in the end, so it vanishes on one
// of nine pieces (t at a limit or free, and m alike): all are tried, and the one with the smallest
// natural map is taken. If several solve the contact (strong coupling), the first in a fixed order
// is taken.
//
// The natural map projects on the pyramid |t| <= mu n, |m| <= rho n: for given n, t and m are
// clamped, and n is the zero of the smallest of four increasing lines, hence the largest of four
// zeros. Moments are divided by a length so that they have the unit of impulses.
#pragma once

#include <algorithm>
#include <cmath>

#include "granular_adapter/nscd/problem/contact_vector.hpp"
#include "granular_adapter/nscd/problem/plane/one_contact.hpp"

namespace turbidite::nscd {

/// Length by which moments are divided in norms: sqrt(W_nn/W_rr) [m].
inline double rolling_length(const Block& w) {
    return std::sqrt(w.nn / w.rr);
}

/// (t, m) for b = (b_t, b_r) on the box |t| <= limit_t, |m| <= limit_m; requires W_rr > 0.
inline Plane solve_on_box(const Block& w, const Plane& b, double limit_t, double limit_m) {
    const double held = std::abs(w.tr) * limit_m;
    const double low = -(b[0] + held) / w.tt, high = -(b[0] - held) / w.tt;
    const double free = -(b[0] - w.tr * b[1] / w.rr) / (w.tt - w.tr * w.tr / w.rr);
    const double t = std::clamp(std::clamp(free, low, high), -limit_t, limit_t);
    return {t, std::clamp(-(b[1] + w.tr * t) / w.rr, -limit_m, limit_m)};
}

/// The r that solves the contact with u = W r + b; requires W_rr > 0.
ContactVector solve_rolling_contact(const Block& w, const ContactVector& b, double friction,
                                    double rolling);

/// The same without rolling resistance.
inline ContactVector without_rolling(const Block& w, const ContactVector& b, double friction) {
    const Plane r = solve_contact(w, {b.n, b.t}, friction);
    return in_plane(r[0], r[1]);
}

/// The point of the pyramid |t| <= mu n, |m| <= rho n closest to x, all three in the same unit.
inline ContactVector project_on_pyramid(const ContactVector& x, double mu, double rho) {
    const double t = mu * std::abs(x.t), m = rho * std::abs(x.roll);
    const double both = (x.n + t + m) / (1.0 + mu * mu + rho * rho);
    const double one = std::max((x.n + t) / (1.0 + mu * mu), (x.n + m) / (1.0 + rho * rho));
    const double n = std::max({0.0, x.n, one, both});
    return in_plane(n, std::clamp(x.t, -mu * n, mu * n), std::clamp(x.roll, -rho * n, rho * n));
}

/// r - P_K(r - s (u + (mu |u_t| + rho |w|, 0, 0))), the moment divided by `length`; zero exactly at
/// a solution [N s].
inline ContactVector rolling_natural_map(const ContactVector& r, const ContactVector& u, double mu,
                                         double rho, double s, double length) {
    const double moment = r.roll / length, spin = u.roll * length;
    const ContactVector nearest =
        project_on_pyramid(in_plane(r.n - s * (u.n + mu * std::abs(u.t) + rho * std::abs(u.roll)),
                                    r.t - s * u.t, moment - s * spin),
                           mu, rho / length);
    return in_plane(r.n - nearest.n, r.t - nearest.t, moment - nearest.roll);
}

}  // namespace turbidite::nscd
