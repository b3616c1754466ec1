// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The contact problem of one step, as plain data:
//
//     v = v_free + M^-1 H r        velocities of the bodies            [m/s, rad/s]
//     u = H^T v + b                contact velocities, (n, t) frame     [m/s]
//     0 <= u_n  perp  r_n >= 0     Signorini condition; b_n contains g/dt
//     |r_t| <= mu r_n, and r_t = -mu r_n u_t/|u_t| unless u_t = 0       Coulomb
//
// The impulses r [N s] are over the step; +r acts on body b and -r on body a (if any). The rolling
// moment impulse m [N m s] acts on b (-m on a) and is conjugate to the relative spin w = spin_b -
// spin_a,
//
//     |m| <= rolling r_n, and m = -rolling r_n w/|w| unless w = 0    rolling resistance
//
// and zero wherever `rolling` is zero. Vectors in contact frames are three-dimensional
// (contact_vector.hpp); mobilities and the operators H and H^T are those of the plane. This file
// does not depend on shapes, laws or solvers.
#pragma once

#include <cstdint>
#include <vector>

#include "granular_adapter/nscd/problem/bodies.hpp"
#include "granular_adapter/nscd/problem/contact_vector.hpp"
#include "granular_adapter/nscd/problem/plane/mobility.hpp"

namespace turbidite::nscd {

/// One entry per contact, in its frame.
using Impulses = std::vector<ContactVector>;

struct Contact {
    std::int32_t a = -1;  ///< -1: at rest and immovable
    std::int32_t b = -1;
    Vec3 normal{};   ///< n, from a to b
    Vec3 tangent{};  ///< t = e_z x n
    Vec3 arm_a{};    ///< from the centre of a to the contact point [m]
    Vec3 arm_b{};
    double friction = 0.0;  ///< mu
    ContactVector bias;     ///< b [m/s]
    double rolling = 0.0;   ///< lever of the rolling resistance, mu_r times a radius [m]
};

struct ContactProblem {
    std::vector<BodyMobility> bodies;
    std::vector<Twist> free;  ///< v_free
    std::vector<Contact> contacts;
    /// Speeds that may have cancelled in v_free, beyond those left in it; their rounding remains
    /// [m/s].
    double cancelled = 0.0;
};

/// t = e_z x n.
Vec3 tangent_of(const Vec3& normal);

/// H_k^T v of one contact, without the bias: u_n, u_t and w.
ContactVector contact_velocity(const Contact& contact, const std::vector<Twist>& v);

/// v_free + M^-1 H r.
std::vector<Twist> body_velocities(const ContactProblem& problem, const Impulses& r);

/// The force part of H_k r_k, as a vector in world axes [N s]; the moment impulse r.roll is not
/// included.
Vec3 world_impulse(const Contact& contact, const ContactVector& r);

}  // namespace turbidite::nscd
