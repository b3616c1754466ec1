// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The exact solution for one contact in the plane, whatever acts there: friction, rolling
// resistance, a film of liquid (film.hpp).
//
// A film alone pushes along n only. Where it cannot keep the surfaces apart, u_n = 0 and its
// impulse is that of the closed gap, c: what is left is a contact without a film at b + W (c, 0,
// 0), which friction and moments belong to. It closes, b_n + W_nn c < 0, exactly where the film
// alone would let the surfaces overlap.
#pragma once

#include "granular_adapter/nscd/problem/plane/rolling_contact.hpp"

namespace turbidite::nscd {

inline ContactVector without_film(const Block& w, const ContactVector& b, double friction,
                                  double rolling) {
    return w.rr > 0.0 && rolling > 0.0 ? solve_rolling_contact(w, b, friction, rolling)
                                       : without_rolling(w, b, friction);
}

/// b of the contact without a film whose solution is what the film at the closed gap does not
/// carry.
inline ContactVector beyond_film(const Block& w, const ContactVector& b) {
    const double closed = w.film->closed();
    return b + in_plane(closed * w.nn, closed * w.nt, closed * w.nr);
}

/// r with u = W r + b that solves the contact; requires a film.
inline ContactVector solve_filmed_contact(const Block& w, const ContactVector& b, double friction,
                                          double rolling) {
    const ContactVector left = beyond_film(w, b);
    if (left.n >= 0.0) return in_plane(solve_film(*w.film, w.nn, b.n).impulse, 0.0);
    ContactVector r = without_film(w, left, friction, rolling);
    r.n += w.film->closed();
    return r;
}

/// What the contact carries of it: |r_t| = mu r_n where it slides, to the last digit.
inline ContactVector carried_part(const Block& w, const ContactVector& b, double friction,
                                  double rolling) {
    const ContactVector left = beyond_film(w, b);
    return left.n >= 0.0 ? ContactVector{} : without_film(w, left, friction, rolling);
}

}  // namespace turbidite::nscd
