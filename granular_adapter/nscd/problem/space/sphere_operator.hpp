// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The operator W = H^T M^-1 H of contacts of spheres. Its blocks are two numbers, cheaper to
// compute than to store:
//
//     W_nn = 1/m_a + 1/m_b,   W_tt = W_nn + r_a^2/I_a + r_b^2/I_b,   r the lengths of the arms
//     W_rr = 1/I_a + 1/I_b    of moments
//
// Moments and tangential impulses are coupled by n x (r_b/I_b - r_a/I_a), which no block contains:
// solvers update them one after the other, and the natural map sees what is left.
#pragma once

#include <vector>

#include "granular_adapter/nscd/problem/contact_kind.hpp"
#include "granular_adapter/nscd/problem/space/filmed_contact.hpp"
#include "granular_adapter/nscd/problem/space/mobility.hpp"

namespace turbidite::nscd {

class SphereOperator {
 public:
    using Mobility = SpaceMobility;
    using Block = SphereBlock;

    /// Keeps a reference to the problem, which must be one of space and outlive it.
    explicit SphereOperator(const ContactProblem& problem)
        : problem_(problem),
          contacts_(problem.contacts),
          bodies_(std::get<std::vector<SpaceMobility>>(problem.bodies)) {}

    const std::vector<SpaceMobility>& bodies() const { return bodies_; }

    SphereBlock block(std::size_t contact) const {
        const Contact& c = contacts_[contact];
        SphereBlock w;
        w.film = film_of(problem_, contact);
        add(w, bodies_[static_cast<std::size_t>(c.b)], c.arm_b);
        if (c.a >= 0) add(w, bodies_[static_cast<std::size_t>(c.a)], c.arm_a);
        return w;
    }

    /// Whether some contact has a bias along its tangents: with a moving wall, or in an impact with
    /// tangential restitution.
    bool has_tangential_bias() const {
        return some(
            [](const Contact& contact) { return contact.bias.t != 0.0 || contact.bias.s != 0.0; });
    }

    /// Whether some contact resists rolling or torsion.
    bool has_moments() const {
        return some(
            [](const Contact& contact) { return contact.rolling > 0.0 || contact.torsion > 0.0; });
    }

    /// Whether some contact, of any rank, has a film.
    bool has_films() const { return on_any_rank(problem_, !problem_.films.empty()); }

 private:
    /// Of the contacts of all ranks.
    template <class Test>
    bool some(const Test& test) const {
        return on_any_rank(problem_, std::any_of(contacts_.begin(), contacts_.end(), test));
    }

    static void add(SphereBlock& w, const SpaceMobility& body, const Vec3& arm) {
        w.nn += body.linear;
        w.tt += body.linear + body.angular * dot(arm, arm);
        w.rr += body.angular;
    }

    const ContactProblem& problem_;
    const std::vector<Contact>& contacts_;
    const std::vector<SpaceMobility>& bodies_;
};

inline SphereOperator operator_of(const ContactProblem& problem,
                                  const std::vector<SpaceMobility>&) {
    return SphereOperator(problem);
}

// One contact with its diagonal block, as contact_kind.hpp asks for it.

inline MapTerms map_terms(const Contact& contact, const SphereBlock& w, const ContactVector& r,
                          const ContactVector& u) {
    if (w.film) return filmed_terms(contact, w, r, u);
    const ContactVector f = natural_map(r, u, contact.friction, 1.0 / w.nn);
    return {f.n * f.n + f.t * f.t + f.s * f.s, r.n * r.n + r.t * r.t + r.s * r.s};
}

inline MapTerms map_terms(const Contact& contact, const SphereBlock& w, const ContactVector& r,
                          const ContactVector& u, const Turning& turning) {
    if (w.rr == 0.0) return map_terms(contact, w, r, u);
    return w.film ? filmed_terms(contact, w, r, u, turning)
                  : turning_terms(contact, w, r, u, turning);
}

inline ContactVector solution(const Contact& contact, const SphereBlock& w,
                              const ContactVector& b) {
    return solve_contact(w, b, contact.friction);
}

inline ContactVector product(const SphereBlock& w, const ContactVector& r) {
    return {w.nn * r.n, w.tt * r.t, w.tt * r.s, 0.0};
}

inline double squared(const SphereBlock&, const ContactVector& u) {
    return u.n * u.n + u.t * u.t + u.s * u.s;
}

static_assert(ContactOperator<SphereOperator>);

}  // namespace turbidite::nscd
