// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A film of liquid between two surfaces that approach or part, as one contact of the problem sees
// it. With the gap at the end of the step, s = g_h + dt v, the film resists with the impulse
//
//     spheres    r_f = -dt C (1/s - 1/g_c) v,                 C = 6 pi eta R*^2
//     discs      r_f = -dt C (s'^{-3/2} - g_c^{-3/2}) v,      C = 3 sqrt(2) pi eta R*^{3/2}
//
// and no film for s >= g_c: the force of lubrication less what the cells resolve (space-wide
// cut-off g_c). s' = min(s, g_h): between discs that part the force at the gap at the end would
// fall faster than the speed rises, and several speeds would fit one impulse; they part with that
// at the start. Here in speeds: gamma = g_h/dt, gamma_c = g_c/dt and sigma = s/dt = v + gamma.
//
// Film and Signorini condition are one monotone relation between u_n = v + b_n and r_n. For one
// contact with u_n = b + W r_n the film alone gives, with sigma_b = b + offset and kappa = W C,
//
//     spheres    (1 - kappa/gamma_c) sigma^2 + (kappa (1 + gamma/gamma_c) - sigma_b) sigma
//                    - kappa gamma = 0
//     discs      f(sigma) = sigma - sigma_b + kappa (sigma^{-3/2} - gamma_c^{-3/2}) (sigma - gamma)
//                    = 0
//
// The first has one root in (0, gamma_c] if sigma_b <= gamma_c; beyond it there is no film and
// sigma = sigma_b. f is increasing and concave where discs close, sigma < gamma, and linear where
// they part. Where u_n = sigma - offset would be negative the surfaces touch, u_n = 0, and the
// contact carries what the film at that gap does not.
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

    /// -r_f over C and the speed sigma - gamma.
    double resistance(double sigma) const {
        if (between == FilmBetween::spheres) return 1.0 / sigma - 1.0 / cutoff;
        return power(std::min(sigma, gap)) - power(cutoff);
    }

    /// r_f at u_n = 0, where the surfaces touch [N s].
    double closed() const {
        if (!acts(0.0)) return 0.0;
        return -coefficient * resistance(offset) * (offset - gap);
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

/// The same between discs that close, sigma_b < min(gamma, gamma_c). f is concave, so that Newton's
/// method rises to the root from any point below it, and from any above it falls below.
inline double root_between_closing_discs(const Film& film, double kappa, double free) {
    const double least = Film::power(film.cutoff), wide = std::min(film.gap, film.cutoff);
    // f = 0 for sigma << gamma: sigma^{-3/2} = gamma_c^{-3/2} + (sigma - sigma_b)/(kappa gamma)
    const double near = least + std::max(0.5 * wide - free, 0.0) / (kappa * film.gap);
    double sigma = std::min(wide, 1.0 / std::cbrt(near * near));
    for (int i = 0; i < 200; ++i) {
        const double power = Film::power(sigma), apart = sigma - film.gap;
        const double f = sigma - free + kappa * (power - least) * apart;
        const double slope = 1.0 + kappa * (power - least - 1.5 * power * apart / sigma);
        const double next = sigma - f / slope;
        if (f <= 0.0 && next <= sigma) break;
        sigma = next > 0.0 ? std::min(next, wide) : 0.0625 * sigma;
    }
    return sigma;
}

/// sigma of a film between discs that acts.
inline double root_between_discs(const Film& film, double w, double free) {
    const double kappa = w * film.coefficient;
    if (free < std::min(film.gap, film.cutoff))
        return kappa > 0.0 ? root_between_closing_discs(film, kappa, free) : free;
    if (film.gap >= film.cutoff) return free;
    return film.gap + (free - film.gap) / (1.0 + kappa * film.resistance(film.gap));
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
