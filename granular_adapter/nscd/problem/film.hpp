// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A film of liquid between two surfaces that approach or part, as one contact of the problem sees
// it. It resists with the force of lubrication less what the cells resolve, from a cut-off g_c on,
//
//     spheres    F = -C (1/g - 1/g_c) v,                C = 6 pi eta R*^2
//     discs      F = -C (g^{-3/2} - g_c^{-3/2}) v,      C = 3 sqrt(2) pi eta R*^{3/2}
//
// and over a step, in which the gap goes from g_h to s = g_h + dt v, with the impulse
//
//     spheres    r_f = -dt C (1/s - 1/g_c) v            the force at the end of the step
//     discs      r_f = -C (Phi(s) - Phi(g_h))           its integral, whatever the speed in between
//                Phi(g) = -2 g^{-1/2} - g g_c^{-3/2},   Phi' = g^{-3/2} - g_c^{-3/2}
//
// (that of discs at the gap at the end would fall faster than the speed rises where they part, and
// several speeds would fit one impulse). No film for s >= g_c: there Phi is Phi(g_c). Here in
// speeds: gamma = g_h/dt, gamma_c = g_c/dt and sigma = s/dt = v + gamma.
//
// Film and Signorini condition are one monotone relation between u_n = v + b_n and r_n. For one
// contact with u_n = b + W r_n the film alone gives, with sigma_b = b + offset and kappa = W C,
//
//     spheres    (1 - kappa/gamma_c) sigma^2 + (kappa (1 + gamma/gamma_c) - sigma_b) sigma
//                    - kappa gamma = 0
//     discs      f(sigma) = sigma - sigma_b + kappa (Phi(sigma) - Phi(gamma)) = 0
//
// The first has one root in (0, gamma_c] if sigma_b <= gamma_c; beyond it there is no film and
// sigma = sigma_b. f rises from minus infinity, concave below gamma_c and with slope 1 above. Where
// u_n = sigma - offset would be negative the surfaces touch, u_n = 0, and the contact carries what
// the film at that gap does not.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace turbidite::nscd {

/// What the film lies between: it gives the power of the gap, and C.
enum class FilmBetween { spheres, discs };

struct Film {
    double coefficient = 0.0;  ///< C [N s], of discs per depth and over sqrt(dt) [N s (m/s)^{1/2}]
    double gap = 0.0;          ///< gamma, of the start of the step [m/s]
    double cutoff = -std::numeric_limits<double>::infinity();  ///< gamma_c; none: no film [m/s]
    double offset = 0.0;                                       ///< sigma - u_n > 0 [m/s]
    FilmBetween between = FilmBetween::spheres;

    bool acts(double u) const {
        return u + offset < cutoff || (between == FilmBetween::discs && gap < cutoff);
    }

    /// Phi(sigma) - Phi(gamma), between discs. With x, y and z the roots of sigma, gamma and
    /// gamma_c it is (x - y) (2 z^3 - x y (x + y))/(x y z^3); in a = z - x and b = z - y, which are
    /// small near the cut-off, nothing cancels.
    double way_to(double sigma) const {
        const double to = std::min(sigma, cutoff), from = std::min(gap, cutoff);
        const double x = std::sqrt(to), y = std::sqrt(from), z = std::sqrt(cutoff);
        const double s = 2.0 * z - x - y, p = (z - x) * (z - y);  // a + b, a b
        return (to - from) / (x + y) * (s * (3.0 * cutoff - s * z + p) - 2.0 * p * z) /
               (x * y * z * cutoff);
    }

    /// r_f where the surfaces touch at the end of the step, u_n = 0 [N s]. Zero if they part by
    /// then, in an impact, whose rebound is already without what the film takes.
    double closed() const {
        if (!acts(0.0)) return 0.0;
        const double closing = between == FilmBetween::spheres
                                   ? (1.0 / offset - 1.0 / cutoff) * (gap - offset)
                                   : -way_to(offset);
        return std::max(coefficient * closing, 0.0);
    }

    /// sigma^{-3/2}
    static double power(double sigma) { return 1.0 / (sigma * std::sqrt(sigma)); }
};

/// The coefficients of a sigma^2 + (p - sigma_b) sigma - q = 0.
struct FilmEquation {
    double a = 1.0, p = 1.0, q = 0.0;

    /// Without a film, numbers that do no harm.
    FilmEquation(const Film& film, double w) {
        if (film.coefficient == 0.0) return;
        const double kappa = w * film.coefficient;
        a = 1.0 - kappa / film.cutoff;
        p = kappa * (1.0 + film.gap / film.cutoff);
        q = kappa * film.gap;
    }
};

/// The normal part of a contact with a film.
struct FilmedNormal {
    double impulse = 0.0;  ///< r_n, of film and contact [N s]
    double contact = 0.0;  ///< of the contact alone, which friction sees, >= 0 [N s]
};

/// The part of r_n that the contact carries if u_n is zero.
inline double touching_part(const Film& film, double impulse) {
    return std::max(impulse - film.closed(), 0.0);
}

/// sigma of a film between spheres that acts.
inline double root_between_spheres(const Film& film, double w, double free) {
    const FilmEquation e(film, w);
    const double p = e.p - free, root = std::sqrt(std::max(p * p + 4.0 * e.a * e.q, 0.0));
    return p >= 0.0 ? 2.0 * e.q / (p + root) : (root - p) / (2.0 * e.a);
}

/// The same between discs. f is concave below the cut-off, so that Newton's method rises to the
/// root from any point below it, and from any above it falls below.
inline double root_between_discs(const Film& film, double w, double free) {
    const double kappa = w * film.coefficient, least = Film::power(film.cutoff);
    const double beyond = free - kappa * film.way_to(film.cutoff);
    if (beyond >= film.cutoff || !(kappa > 0.0)) return beyond;
    // f = 0 without its linear part: sigma^{-1/2} = -(sigma_b/kappa + Phi(gamma))/2
    const double from = std::min(film.gap, film.cutoff);
    const double near = 1.0 / std::sqrt(from) + 0.5 * (from * least - free / kappa);
    double sigma = near > 0.0 ? std::min(1.0 / (near * near), film.cutoff) : film.cutoff;
    bool below = false;
    for (int i = 0; i < 40; ++i) {
        const double f = sigma - free + kappa * film.way_to(sigma);
        const double next = sigma - f / (1.0 + kappa * (Film::power(sigma) - least));
        if (next == sigma || (below && next <= sigma)) break;
        below = below || f <= 0.0;
        sigma = next > 0.0 ? std::min(next, film.cutoff) : 0.0625 * sigma;
    }
    return sigma;
}

/// r_n with u_n = W r_n + b.
inline FilmedNormal solve_film(const Film& film, double w, double b) {
    const double free = b + film.offset;
    double sigma = free;
    if (film.acts(b))
        sigma = film.between == FilmBetween::spheres ? root_between_spheres(film, w, free)
                                                     : root_between_discs(film, w, free);
    const double u = std::max(sigma - film.offset, 0.0), impulse = (u - b) / w;
    return {impulse, sigma < film.offset ? touching_part(film, impulse) : 0.0};
}

}  // namespace turbidite::nscd
