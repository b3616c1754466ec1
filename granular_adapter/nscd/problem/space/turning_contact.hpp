// SPDX-License-Identifier: LGPL-2.1-or-later
//
// One contact of spheres with resistance to rolling and torsion: a moment impulse m on b whose part
// along the normal is limited by torsion r_n and whose other part by rolling r_n, each opposing its
// part of the relative spin (contact_problem.hpp).
//
// Friction and moments are three limits on the normal impulse, in cone K with
//
//     |r_t| <= c_1 r_n,  |m_r|/L <= c_2 r_n,  |m_n|/L <= c_3 r_n,   c = (mu, rolling/L, torsion/L)
//
// Moments are divided, and spins multiplied, by the length L = sqrt(W_nn/W_rr), W_rr = 1/I_a +
// 1/I_b. The point of K closest to x has the n that solves
//
//     n - x_n - sum_i max(0, c_i (|x_i| - c_i n)) = 0
//
// The left-hand side is the smallest, over all sets S of the limits, of the increasing functions
// with the sum over S instead, so n is the largest of their zeros
//
//     n_S = (x_n + sum_S c_i |x_i|)/(1 + sum_S c_i^2)
//
// or zero if that is negative.
#pragma once

#include "coupler/rigid/vec3.hpp"
#include "granular_adapter/nscd/problem/contact_kind.hpp"
#include "granular_adapter/nscd/problem/space/one_contact.hpp"

namespace turbidite::nscd {

/// Length by which moments are divided in norms; requires W_rr > 0 [m].
inline double turning_length(const SphereBlock& w) {
    return std::sqrt(w.nn / w.rr);
}

/// n of the point of K closest to a point with these sizes of the three parts.
inline double nearest_normal(double n, const std::array<double, 3>& size,
                             const std::array<double, 3>& slope) {
    double largest = 0.0;
    for (unsigned set = 0; set < 8; ++set) {
        double sum = n, square = 1.0;
        for (unsigned i = 0; i < 3; ++i)
            if (set >> i & 1u) sum += slope[i] * size[i], square += slope[i] * slope[i];
        largest = std::max(largest, sum / square);
    }
    return largest;
}

/// A vector, not longer than `most`.
inline Vec3 clipped(const Vec3& x, double most) {
    const double size = norm(x);
    return size > most ? (most / size) * x : x;
}

/// |r - P_K(r - s (u + (mu |u_t| + rolling |w_r| + torsion |w_n|, 0)))|^2 and |r|^2, s = 1/W_nn,
/// moments included; zero exactly at a solution [(N s)^2].
inline MapTerms turning_terms(const Contact& contact, const SphereBlock& w, const ContactVector& r,
                              const ContactVector& u, const Turning& turning) {
    const double length = turning_length(w), s = 1.0 / w.nn;
    const std::array<double, 3> slope{contact.friction, contact.rolling / length,
                                      contact.torsion / length};
    const auto along = [&](const Vec3& x) { return dot(contact.normal, x) * contact.normal; };
    const Vec3 moment = (1.0 / length) * turning.moment, spin = length * turning.spin;
    const Vec3 spin_n = along(spin), spin_r = spin - spin_n;
    const Vec3 moment_n = along(moment), moment_r = moment - moment_n;
    const ContactVector t{0.0, r.t - s * u.t, r.s - s * u.s, 0.0};
    const Vec3 roll = moment_r - s * spin_r, twist = moment_n - s * spin_n;
    const double slip = slope[0] * std::sqrt(u.t * u.t + u.s * u.s) + slope[1] * norm(spin_r) +
                        slope[2] * norm(spin_n);
    const double n = nearest_normal(
        r.n - s * (u.n + slip), {std::sqrt(t.t * t.t + t.s * t.s), norm(roll), norm(twist)}, slope);
    const ContactVector held = clipped(t, slope[0] * n);
    const Vec3 fr = moment_r - clipped(roll, slope[1] * n);
    const Vec3 fw = moment_n - clipped(twist, slope[2] * n);
    const double fn = r.n - n, ft = r.t - held.t, fs = r.s - held.s;
    return {fn * fn + ft * ft + fs * fs + dot(fr, fr) + dot(fw, fw),
            r.n * r.n + r.t * r.t + r.s * r.s + dot(moment, moment)};
}

}  // namespace turbidite::nscd
