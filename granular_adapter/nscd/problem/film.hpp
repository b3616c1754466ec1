// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A film of liquid between two surfaces that approach or part, as one contact of the problem sees
// it. With the gap at the end of the step, s = g_h + dt v, the film resists with the impulse
//
//     r_f = -dt C (1/s - 1/g_c) v,     C = 6 pi eta R*^2,     no film for s >= g_c
//
// which is the force of lubrication between spheres at the gap at the end of the step, less what
// the cells resolve (space-wide cut-off g_c). Here in speeds: gamma = g_h/dt, gamma_c = g_c/dt and
// sigma = s/dt = v + gamma.
//
// Film and Signorini condition are one monotone relation between u_n = v + b_n and r_n. For one
// contact with u_n = b + W r_n the film alone gives, with sigma_b = b + offset and kappa = W C,
//
//     (1 - kappa/gamma_c) sigma^2 + (kappa (1 + gamma/gamma_c) - sigma_b) sigma - kappa gamma = 0
//
// which has one root in (0, gamma_c] if sigma_b <= gamma_c; beyond it there is no film and sigma =
// sigma_b. Where u_n = sigma - offset would be negative the surfaces touch, u_n = 0, and the
// contact carries what the film at that gap does not.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace turbidite::nscd {

struct Film {
    double coefficient = 0.0;  ///< C [N s]
    double gap = 0.0;          ///< gamma, of the start of the step [m/s]
    double cutoff = -std::numeric_limits<double>::infinity();  ///< gamma_c; none: no film [m/s]
    double offset = 0.0;                                       ///< sigma - u_n > 0 [m/s]

    bool acts(double u) const { return u + offset < cutoff; }

    /// r_f at u_n = 0, where the surfaces touch [N s].
    double closed() const {
        if (!acts(0.0)) return 0.0;
        return -coefficient * (1.0 / offset - 1.0 / cutoff) * (offset - gap);
    }
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

/// r_n with u_n = W r_n + b.
inline FilmedNormal solve_film(const Film& film, double w, double b) {
    const double free = b + film.offset;
    double sigma = free;
    if (film.acts(b)) {
        const FilmEquation e(film, w);
        const double p = e.p - free, root = std::sqrt(std::max(p * p + 4.0 * e.a * e.q, 0.0));
        sigma = p >= 0.0 ? 2.0 * e.q / (p + root) : (root - p) / (2.0 * e.a);
    }
    const double u = std::max(sigma - film.offset, 0.0), impulse = (u - b) / w;
    return {impulse, sigma < film.offset ? touching_part(film, impulse) : 0.0};
}

}  // namespace turbidite::nscd
