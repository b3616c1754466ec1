// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/plane/rolling_contact.hpp"

#include <limits>

namespace turbidite::nscd {
namespace {

Vec3 velocity(const Block& w, const Vec3& b, const Vec3& r) {
    return {b[0] + w.nn * r[0] + w.nt * r[1] + w.nr * r[2],
            b[1] + w.nt * r[0] + w.tt * r[1] + w.tr * r[2],
            b[2] + w.nr * r[0] + w.tr * r[1] + w.rr * r[2]};
}

/// One of the nine pieces: t = t_limit n or free (then u_t = 0), m = m_limit n or free; u_n = 0.
struct Piece {
    double t_limit, m_limit;
    bool t_free, m_free;

    /// Not finite or not positive in n where the piece has no solution.
    Vec3 solution(const Block& w, const Vec3& b) const {
        // Per unit of n, with t and m at their limits or zero.
        const Vec3 edge = velocity(w, {}, {1.0, t_limit, m_limit});
        // What t and m do while free, as an affine function of n: (t, m) = base + slope n.
        Plane base{}, slope{t_limit, m_limit};
        if (t_free && m_free) {
            const double det = w.tt * w.rr - w.tr * w.tr;
            base = {(-b[1] * w.rr + b[2] * w.tr) / det, (-b[2] * w.tt + b[1] * w.tr) / det};
            slope = {(-edge[1] * w.rr + edge[2] * w.tr) / det,
                     (-edge[2] * w.tt + edge[1] * w.tr) / det};
        } else if (t_free) {
            base[0] = -b[1] / w.tt, slope[0] = -edge[1] / w.tt;
        } else if (m_free) {
            base[1] = -b[2] / w.rr, slope[1] = -edge[2] / w.rr;
        }
        const double rise = w.nn + w.nt * slope[0] + w.nr * slope[1];
        const double n = -(b[0] + w.nt * base[0] + w.nr * base[1]) / rise;
        return {n, base[0] + slope[0] * n, base[1] + slope[1] * n};
    }
};

Vec3 best_of_nine(const Block& w, const Vec3& b, double mu, double rho) {
    const double length = rolling_length(w), s = 1.0 / w.nn;
    double least = std::numeric_limits<double>::infinity();
    Vec3 best{};
    for (const int t : {0, 1, -1})
        for (const int m : {0, 1, -1}) {
            const Vec3 r = Piece{t * mu, m * rho, t == 0, m == 0}.solution(w, b);
            if (!(r[0] > 0.0) || !std::isfinite(r[0])) continue;
            const Vec3 f = rolling_natural_map(r, velocity(w, b, r), mu, rho, s, length);
            const double error = (f[0] * f[0] + f[1] * f[1] + f[2] * f[2]) / (r[0] * r[0]);
            if (error < least) least = error, best = r;
            if (error < 1e-28) return best;
        }
    return best;
}

/// A free component may pass its limit by rounding; friction never exceeds it.
Vec3 within_limits(const Vec3& r, double mu, double rho) {
    return {r[0], std::clamp(r[1], -mu * r[0], mu * r[0]),
            std::clamp(r[2], -rho * r[0], rho * r[0])};
}

}  // namespace

Vec3 solve_rolling_contact(const Block& w, const Vec3& b, double friction, double rolling) {
    if (b[0] >= 0.0) return {};
    if (w.nt != 0.0 || w.nr != 0.0)
        return within_limits(best_of_nine(w, b, friction, rolling), friction, rolling);
    const double n = -b[0] / w.nn;
    const Plane rest = solve_on_box(w, {b[1], b[2]}, friction * n, rolling * n);
    return {n, rest[0], rest[1]};
}

}  // namespace turbidite::nscd
