// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The exact solution of Signorini-Coulomb for one contact in the plane, for any symmetric positive
// definite W: given b (the velocity without this contact's impulse), find r with u = W r + b and
//
//     0 <= u_n perp r_n >= 0,   |r_t| <= mu r_n,   r_t = -mu r_n u_t/|u_t| unless u_t = 0.
//
//     b_n >= 0                    r = 0
//     stick trial                 W r = -b; accepted if |r_t| <= mu r_n
//     slide, s = sign of the      r_n = -b_n / (W_nn + s mu W_nt),   r_t = s mu r_n
//     trial's r_t
//
// With c = b_t - W_nt b_n/W_nn and A = W_tt - W_nt^2/W_nn the trial is r_t = -c/A. If it is
// rejected, the function |r_t(a)| - mu r_n(a), r_t(a) = -c/(A + a), changes sign over a in (0,
// infinity), so a sliding solution in the direction of the trial exists, with W_nn + s mu W_nt > 0.
// The sign of the trial's r_n must not be tested: with strong W_nt it may be negative although the
// contact closes.
//
// If b_n >= 0 and W_nn + s mu W_nt < 0 (Painleve) a second solution exists; r = 0 is chosen.
#pragma once

#include <array>
#include <cmath>

#include "granular_adapter/nscd/problem/film.hpp"

namespace turbidite::nscd {

/// Diagonal block of W [1/kg]. The third row is for moments and spins (rolling_contact.hpp), and
/// zero without rolling resistance [1/(kg m), 1/(kg m2)].
struct Block {
    double nn = 0.0;
    double nt = 0.0;
    double tt = 0.0;
    double nr = 0.0;
    double tr = 0.0;
    double rr = 0.0;
    const Film* film = nullptr;  ///< none: the contact has no film (filmed_contact.hpp)
};

/// (n, t) of an impulse or a velocity.
using Plane = std::array<double, 2>;

/// r with u = W r + b that solves the contact; b and r in (n, t).
inline Plane solve_contact(const Block& w, const Plane& b, double friction) {
    if (b[0] >= 0.0) return {0.0, 0.0};
    const double a = w.tt - w.nt * w.nt / w.nn;         // A = W_tt - W_nt^2/W_nn
    const double t = -(b[1] - w.nt * b[0] / w.nn) / a;  // stick: r_t = -c/A
    const double n = -(b[0] + w.nt * t) / w.nn;         // r_n = -(b_n + W_nt r_t)/W_nn
    if (std::abs(t) <= friction * n) return {n, t};
    const double s = std::copysign(1.0, t);
    const double slide = -b[0] / (w.nn + s * friction * w.nt);  // slide: r_n
    return {slide, s * friction * slide};
}

/// The point of the cone |t| <= mu n closest to x.
inline Plane project_on_cone(const Plane& x, double friction) {
    const double n = x[0], t = std::abs(x[1]);
    // For mu = 0 the second condition alone holds for any n.
    if (n >= 0.0 && t <= friction * n) return x;
    if (friction * t <= -n) return {0.0, 0.0};
    const double on_edge = (n + friction * t) / (1.0 + friction * friction);
    return {on_edge, std::copysign(friction * on_edge, x[1])};
}

/// r - P_K(r - rho (u + (mu |u_t|, 0))), P_K the projection on the friction cone K: zero exactly at
/// a solution [N s].
inline Plane natural_map(const Plane& r, const Plane& u, double friction, double rho) {
    const Plane target = {r[0] - rho * (u[0] + friction * std::abs(u[1])), r[1] - rho * u[1]};
    const Plane nearest = project_on_cone(target, friction);
    return {r[0] - nearest[0], r[1] - nearest[1]};
}

}  // namespace turbidite::nscd
