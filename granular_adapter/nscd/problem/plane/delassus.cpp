// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/problem/plane/delassus.hpp"

#include <algorithm>

#include "coupler/rigid/vec3.hpp"

namespace turbidite::nscd {
namespace {

/// Contribution of one body to W_kk: (d_i, arm x d_i) . M^-1 (d_j, arm x d_j) for d = n, t. For
/// isotropic mobility n . n = t . t = 1 and n . t = 0 are used, which rounded directions would not
/// satisfy exactly.
void add_share(Block& w, const Contact& contact, const Vec3& arm, const BodyMobility& body) {
    // arm x n, arm x t
    const double n = cross_z(arm, contact.normal), t = cross_z(arm, contact.tangent);
    if (body.isotropic()) {
        w.nn += body.xx + body.ss * n * n;  // 1/m + (arm x n)^2/I
        w.nt += body.ss * n * t;
        w.tt += body.xx + body.ss * t * t;
        return;
    }
    const PlanarVector along_n{contact.normal[0], contact.normal[1], n};
    const PlanarVector along_t{contact.tangent[0], contact.tangent[1], t};
    const PlanarVector answer = body * along_t;
    w.nn += dot(along_n, body * along_n);
    w.nt += dot(along_n, answer);
    w.tt += dot(along_t, answer);
}

/// The same for a unit moment: (0, 0, 1).
void add_rolling_share(Block& w, const Contact& contact, const Vec3& arm,
                       const BodyMobility& body) {
    const double n = cross_z(arm, contact.normal), t = cross_z(arm, contact.tangent);
    const PlanarVector answer = body * PlanarVector{0.0, 0.0, 1.0};
    w.nr += dot(PlanarVector{contact.normal[0], contact.normal[1], n}, answer);
    w.tr += dot(PlanarVector{contact.tangent[0], contact.tangent[1], t}, answer);
    w.rr += answer.spin;
}

/// Rounding of n and t leaves about 1e-17 in place of an exact zero.
void drop_rounding(Block& w) {
    if (std::abs(w.nt) < 1e-14 * std::min(w.nn, w.tt)) w.nt = 0.0;
    if (w.nr * w.nr < 1e-28 * w.nn * w.rr) w.nr = 0.0;
}

/// Whether the arm is along the normal to rounding: then no spin causes a velocity along n.
bool is_along_normal(const Contact& contact, const Vec3& arm) {
    return std::abs(cross_z(arm, contact.normal)) <= 1e-14 * norm(arm);
}

Block block_of(const std::vector<PlanarTensor>& bodies, const Contact& contact) {
    Block w;
    const auto add = [&](const Vec3& arm, const BodyMobility& body) {
        add_share(w, contact, arm, body);
        if (contact.rolling > 0.0) add_rolling_share(w, contact, arm, body);
    };
    add(contact.arm_b, bodies[contact.b]);
    if (contact.a >= 0) add(contact.arm_a, bodies[contact.a]);
    drop_rounding(w);
    return w;
}

}  // namespace

// The blocks alone do not tell whether W is diagonal: contributions of two bodies may cancel, and a
// driven body has none.
Delassus::Delassus(const ContactProblem& problem)
    : problem_(problem),
      bodies_(std::get<std::vector<PlanarTensor>>(problem.bodies)),
      diagonal_(std::all_of(bodies_.begin(), bodies_.end(),
                            [](const BodyMobility& body) { return body.isotropic(); })) {
    blocks_.reserve(problem.contacts.size());
    for (std::size_t k = 0; k < problem.contacts.size(); ++k) {
        const Contact& contact = problem.contacts[k];
        Block w = block_of(bodies_, contact);
        w.film = film_of(problem, k);
        diagonal_ = diagonal_ && w.nt == 0.0 && w.nr == 0.0 &&
                    is_along_normal(contact, contact.arm_b) &&
                    is_along_normal(contact, contact.arm_a);
        rolling_ = rolling_ || w.rr > 0.0;
        blocks_.push_back(w);
    }
    // Which rows the sweeps use must not depend on which contacts this rank has.
    diagonal_ = !on_any_rank(problem, !diagonal_);
    rolling_ = on_any_rank(problem, rolling_);
    filmed_ = on_any_rank(problem, !problem.films.empty());
}

Impulses Delassus::apply(const Impulses& r) const {
    // W r is what r alone does: the same sums with v_free = 0.
    const std::vector<Twist> rest(problem_.free.size());
    const std::vector<Twist> v =
        body_velocities({problem_.bodies, rest, problem_.contacts, 0.0}, r);
    Impulses u;
    u.reserve(r.size());
    for (const Contact& contact : problem_.contacts) u.push_back(contact_velocity(contact, v));
    return u;
}

}  // namespace turbidite::nscd
