// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the general code asks of a kind of contact, such as those of the folders plane/ and space/:
// types, and functions of these types.
//
//     mobility M    M^-1 of a body
//         push(twist, M, arm, p, roll)     v += M^-1 (p, arm x p + roll e_z)
//         is_immovable(M)                  whether no impulse moves the body
//         turn(twist, M, m)                in space: the spin by a moment impulse m
//     operator W    W = H^T M^-1 H of a problem
//         operator_of(problem, bodies)     makes it
//         W.bodies(), W.block(k)           mobilities; the diagonal block of contact k
//     block B       W_kk, with the entry B.nn, and its film B.film or nullptr
//         map_terms(contact, B, r, u)      |natural map|^2 and |r|^2
//         solution(contact, B, b)          the r of the contact alone, u = W_kk r + b
//         product(B, r)                    W_kk r
//         squared(B, u)                    |u|^2, with spins scaled to velocities
//         map_terms(contact, B, r, u, turning)   in space: of contacts with moments
//         carried_part(contact, B, r, u)         with a film: what the contact carries
//         held_moment(contact, B, n, turning)    in space: of a contact that carries n
//
// A kind that nlgs solves also has packed rows (sweeps/sweep_layout.hpp), and a function that
// chooses them by the operator,
//
//         with_rows(W, use)                use(std::type_identity<Rows>())
#pragma once

#include <concepts>

#include "granular_adapter/nscd/problem/contact_problem.hpp"

namespace turbidite::nscd {

/// |natural map|^2 and |r|^2 of one contact.
struct MapTerms {
    double error, size;
};

/// Moment impulse and relative spin of a contact in space, in world axes.
struct Turning {
    Vec3 moment{}, spin{};
};

template <class M>
concept MobilityKind = requires(const M& body, Twist& twist, const Vec3& x, double roll) {
    push(twist, body, x, x, roll);
    { is_immovable(body) } -> std::same_as<bool>;
};

template <class W>
concept ContactOperator = MobilityKind<typename W::Mobility> &&
    requires(const W& w, const typename W::Block& block, const Contact& contact,
             const ContactVector& x) {
    { w.bodies() } -> std::same_as<const std::vector<typename W::Mobility>&>;
    { w.block(std::size_t{}) } -> std::convertible_to<const typename W::Block&>;
    { block.nn } -> std::convertible_to<double>;
    { block.film } -> std::convertible_to<const Film*>;
    { map_terms(contact, block, x, x) } -> std::same_as<MapTerms>;
    { solution(contact, block, x) } -> std::same_as<ContactVector>;
    { product(block, x) } -> std::same_as<ContactVector>;
    { squared(block, x) } -> std::same_as<double>;
};

}  // namespace turbidite::nscd
