// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/problem/plane/rolling_contact.hpp"

#include <limits>

namespace turbidite::nscd {
namespace {

ContactVector velocity(const Block& w, const ContactVector& b, const ContactVector& r) {
    return in_plane(b.n + w.nn * r.n + w.nt * r.t + w.nr * r.roll,
                    b.t + w.nt * r.n + w.tt * r.t + w.tr * r.roll,
                    b.roll + w.nr * r.n + w.tr * r.t + w.rr * r.roll);
}

/// One of the nine pieces: t = t_limit n or free (then u_t = 0), m = m_limit n or free; u_n = 0.
struct Piece {
    double t_limit, m_limit;
    bool t_free, m_free;

    /// Not finite, or not positive in n, if the piece has no solution.
    ContactVector solution(const Block& w, const ContactVector& b) const {
        // Velocity per unit of n, with t and m at their limits or zero.
        const ContactVector edge = velocity(w, {}, in_plane(1.0, t_limit, m_limit));
        // Free t and m as affine functions of n: (t, m) = base + slope n.
        Plane base{}, slope{t_limit, m_limit};
        if (t_free && m_free) {
            const double det = w.tt * w.rr - w.tr * w.tr;
            base = {(-b.t * w.rr + b.roll * w.tr) / det, (-b.roll * w.tt + b.t * w.tr) / det};
            slope = {(-edge.t * w.rr + edge.roll * w.tr) / det,
                     (-edge.roll * w.tt + edge.t * w.tr) / det};
        } else if (t_free) {
            base[0] = -b.t / w.tt, slope[0] = -edge.t / w.tt;
        } else if (m_free) {
            base[1] = -b.roll / w.rr, slope[1] = -edge.roll / w.rr;
        }
        // u_n = b_n + W_nt t_0 + W_nr m_0 + rise n = 0
        const double rise = w.nn + w.nt * slope[0] + w.nr * slope[1];
        const double n = -(b.n + w.nt * base[0] + w.nr * base[1]) / rise;
        return in_plane(n, base[0] + slope[0] * n, base[1] + slope[1] * n);
    }
};

ContactVector best_of_nine(const Block& w, const ContactVector& b, double mu, double rho) {
    const double length = rolling_length(w), s = 1.0 / w.nn;
    double least = std::numeric_limits<double>::infinity();
    ContactVector best{};
    for (const int t : {0, 1, -1})
        for (const int m : {0, 1, -1}) {
            const ContactVector r = Piece{t * mu, m * rho, t == 0, m == 0}.solution(w, b);
            if (!(r.n > 0.0) || !std::isfinite(r.n)) continue;
            const ContactVector f = rolling_natural_map(r, velocity(w, b, r), mu, rho, s, length);
            const double error = (f.n * f.n + f.t * f.t + f.roll * f.roll) / (r.n * r.n);
            if (error < least) least = error, best = r;
            // A relative error of 1e-14: solved to rounding, so that the other pieces need not be
            // tried.
            if (error < 1e-28) return best;
        }
    return best;
}

/// A free component may exceed its limit by rounding; friction must not.
ContactVector within_limits(const ContactVector& r, double mu, double rho) {
    return in_plane(r.n, std::clamp(r.t, -mu * r.n, mu * r.n),
                    std::clamp(r.roll, -rho * r.n, rho * r.n));
}

}  // namespace

ContactVector solve_rolling_contact(const Block& w, const ContactVector& b, double friction,
                                    double rolling) {
    if (b.n >= 0.0) return {};
    if (w.nt != 0.0 || w.nr != 0.0)
        return within_limits(best_of_nine(w, b, friction, rolling), friction, rolling);
    // W_nt = W_nr = 0: the normal part is a problem of its own, and gives the box of (t, m).
    const double n = -b.n / w.nn;
    const Plane rest = solve_on_box(w, {b.t, b.roll}, friction * n, rolling * n);
    return in_plane(n, rest[0], rest[1]);
}

}  // namespace turbidite::nscd
