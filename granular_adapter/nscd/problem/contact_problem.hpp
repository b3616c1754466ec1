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
// spin_a + b_w, where the bias contains the spin of a wall,
//
//     |m| <= rolling r_n, and m = -rolling r_n w/|w| unless w = 0    rolling resistance
//
// and zero wherever `rolling` is zero. In space m and w are vectors: their parts in the tangent
// plane obey this law, and their parts along the normal the same with `torsion` as the lever. The
// mobilities M^-1 are those of a kind of contact (contact_kind.hpp); everything else is the same in
// the plane and in space. With films of liquid r_n may be negative, and mu r_n, rolling r_n and
// torsion r_n are limits by the part of r_n that the contact carries (film.hpp). This file does not
// depend on shapes, laws or solvers.
#pragma once

#include <cstdint>
#include <vector>

#include "granular_adapter/nscd/problem/bodies.hpp"
#include "granular_adapter/nscd/problem/contact_cells.hpp"
#include "granular_adapter/nscd/problem/contact_vector.hpp"
#include "granular_adapter/nscd/problem/film.hpp"
#include "granular_adapter/nscd/problem/mobilities.hpp"
#include "granular_adapter/nscd/ranks/rank_plan.hpp"

namespace turbidite::nscd {

/// One entry per contact, in its frame.
struct Impulses : std::vector<ContactVector> {
    using std::vector<ContactVector>::vector;
    Impulses(std::vector<ContactVector> impulses)
        : std::vector<ContactVector>(std::move(impulses)) {}

    /// In space, the moment impulses on b by rolling and torsional resistance, in world axes; empty
    /// if there is no such resistance, and in the plane [N m s].
    std::vector<Vec3> moments;

    friend bool operator==(const Impulses& a, const Impulses& b) {
        const auto& one = static_cast<const std::vector<ContactVector>&>(a);
        return one == static_cast<const std::vector<ContactVector>&>(b) && a.moments == b.moments;
    }
};

struct Contact {
    std::int32_t a = -1;  ///< -1: at rest and immovable
    std::int32_t b = -1;
    Vec3 normal{};   ///< n, from a to b
    Vec3 tangent{};  ///< t, tangent_of(n)
    Vec3 arm_a{};    ///< from the centre of a to the contact point [m]
    Vec3 arm_b{};
    double friction = 0.0;  ///< mu
    ContactVector bias;     ///< b [m/s], in the plane also that of the relative spin [rad/s]
    Vec3 spin_bias{};       ///< in space: of the relative spin [rad/s]
    /// How much farther a rebound demands the bodies to be at the end of the step than a contact
    /// without one, over the step; >= 0 [m/s].
    double rebound_lead = 0.0;
    double rolling = 0.0;  ///< lever of the rolling resistance, mu_r times a radius [m]
    double torsion = 0.0;  ///< lever of the torsional resistance, in space [m]
};

struct ContactProblem {
    Mobilities bodies;
    std::vector<Twist> free;  ///< v_free
    std::vector<Contact> contacts;
    /// Speeds that may have cancelled in v_free, beyond those left in it; their rounding remains
    /// [m/s].
    double cancelled = 0.0;
    ContactCells cells = {};  ///< of the contacts; empty on one rank in the plane
    /// Where other ranks have contacts of the same problem, then those of this rank are in phases.
    const RankPlan* ranks = nullptr;
    /// One per contact, or empty: no contact of this rank has a film.
    std::vector<Film> films = {};
};

/// The films, or none, of contact k.
inline const Film* film_of(const ContactProblem& problem, std::size_t k) {
    return problem.films.empty() ? nullptr : &problem.films[k];
}

/// Contacts of all ranks.
inline std::size_t contacts_in_all(const ContactProblem& problem) {
    return problem.ranks ? problem.ranks->contacts() : problem.contacts.size();
}

/// Whether something is true on one of the ranks that share a problem; collective.
inline bool on_any_rank(const ContactProblem& problem, bool here) {
    return problem.ranks ? problem.ranks->any(here) : here;
}

/// Calls visit(k) for the contacts of a problem in their order. `values`, one per body, are those
/// of all ranks before the contacts of each phase, and at the end.
template <class Visit>
void each_contact(const ContactProblem& problem, std::vector<Twist>& values, const Visit& visit) {
    if (problem.ranks) return problem.ranks->each_contact(values, visit);
    for (std::size_t k = 0; k < problem.contacts.size(); ++k) visit(k);
}

/// t = e_z x n, of length 1; e_x where n is along e_z.
Vec3 tangent_of(const Vec3& normal);

/// s = n x t.
inline Vec3 binormal_of(const Contact& contact) {
    return cross(contact.normal, contact.tangent);
}

/// A vector in the frame of the contact.
inline ContactVector in_frame(const Contact& contact, const Vec3& x) {
    return {dot(contact.normal, x), dot(contact.tangent, x), dot(binormal_of(contact), x), 0.0};
}

/// H_k^T v of one contact, without the bias: the velocity and the spin of b relative to a. Inline,
/// since most callers use few of the components.
inline ContactVector contact_velocity(const Contact& contact, const std::vector<Twist>& v) {
    const Twist& b = v[static_cast<std::size_t>(contact.b)];
    Vec3 u = b.at(contact.arm_b);
    double spin = b.spin[2];
    if (contact.a >= 0) {
        const Twist& a = v[static_cast<std::size_t>(contact.a)];
        u = u - a.at(contact.arm_a);
        spin -= a.spin[2];
    }
    ContactVector result = in_frame(contact, u);
    result.roll = spin;
    return result;
}

/// The force part of H_k r_k, as a vector in world axes [N s].
inline Vec3 world_impulse(const Contact& contact, const ContactVector& r) {
    const Vec3 p = r.n * contact.normal + r.t * contact.tangent;
    return r.s == 0.0 ? p : p + r.s * binormal_of(contact);
}

/// The moment impulse on b of contact k, likewise [N m s].
inline Vec3 world_moment(const Impulses& r, std::size_t k) {
    return r.moments.empty() ? Vec3{0.0, 0.0, r[k].roll} : r.moments[k];
}

/// Spin of b relative to a, without the bias [rad/s].
inline Vec3 relative_spin(const Contact& contact, const std::vector<Twist>& v) {
    const Vec3& b = v[static_cast<std::size_t>(contact.b)].spin;
    return contact.a < 0 ? b : b - v[static_cast<std::size_t>(contact.a)].spin;
}

/// v_free + M^-1 H r.
std::vector<Twist> body_velocities(const ContactProblem& problem, const Impulses& r);

/// W_nn of a contact [1/kg].
double normal_mobility(const Mobilities& bodies, const Contact& contact);

/// The same for these mobilities, whatever the problem's.
template <class Mobility>
std::vector<Twist> body_velocities(const ContactProblem& problem,
                                   const std::vector<Mobility>& bodies, const Impulses& r) {
    std::vector<Twist> v = problem.free;
    each_contact(problem, v, [&](std::size_t k) {
        if (r[k] == ContactVector{}) return;
        const Contact& contact = problem.contacts[k];
        const Vec3 p = world_impulse(contact, r[k]);
        push(v[contact.b], bodies[contact.b], contact.arm_b, p, r[k].roll);
        if (contact.a >= 0)
            push(v[contact.a], bodies[contact.a], contact.arm_a, -1.0 * p, -r[k].roll);
    });
    if constexpr (requires { turn(v[0], bodies[0], Vec3{}); })
        if (on_any_rank(problem, !r.moments.empty()))
            each_contact(problem, v, [&](std::size_t k) {
                const Contact& contact = problem.contacts[k];
                turn(v[contact.b], bodies[contact.b], r.moments[k]);
                if (contact.a >= 0) turn(v[contact.a], bodies[contact.a], -r.moments[k]);
            });
    return v;
}

}  // namespace turbidite::nscd
