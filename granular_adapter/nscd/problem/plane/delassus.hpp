// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Delassus operator W = H^T M^-1 H (Topin 2011, Eq. 19): maps contact impulses to the change of
// contact velocity they cause, u = H^T v_free + b + W r. [1/kg]
//
// r is an impulse, so W does not contain dt. W is applied, never
// assembled; only its diagonal blocks are stored, in (n, t, roll). For discs the arms are parallel
// to n, hence W_nt = 0 in every block, unless the mobility of a body is anisotropic or couples
// translation to spin.
#pragma once

#include <vector>

#include "granular_adapter/nscd/problem/contact_kind.hpp"
#include "granular_adapter/nscd/problem/plane/filmed_contact.hpp"

namespace turbidite::nscd {

class Delassus {
 public:
    using Mobility = PlanarTensor;
    using Block = nscd::Block;

    /// Keeps a reference to the problem, which must be one of the plane and outlive it. Collective.
    explicit Delassus(const ContactProblem& problem);

    const std::vector<PlanarTensor>& bodies() const { return bodies_; }
    const Block& block(std::size_t contact) const { return blocks_[contact]; }

    /// W r: the changes of u_n, u_t and w of every contact.
    Impulses apply(const Impulses& r) const;

    /// True if all arms are along the normals, no block couples n and t, and every mobility is
    /// isotropic, of all ranks.
    bool diagonal() const { return diagonal_; }

    /// True if some contact of any rank has rolling resistance. Only the blocks of such contacts
    /// have a non-zero third row, and not even these if neither body can rotate: then there is no
    /// moment.
    bool rolling() const { return rolling_; }

    /// True if some contact of any rank has a film.
    bool filmed() const { return filmed_; }

 private:
    const ContactProblem& problem_;
    const std::vector<PlanarTensor>& bodies_;
    std::vector<Block> blocks_;
    bool diagonal_ = true, rolling_ = false, filmed_ = false;
};

inline Delassus operator_of(const ContactProblem& problem, const std::vector<PlanarTensor>&) {
    return Delassus(problem);
}

// One contact with its diagonal block, as contact_kind.hpp asks for it. Inline, for the loops of
// measures.hpp.

inline MapTerms rolling_terms(const Contact& contact, const Block& w, const ContactVector& r,
                              const ContactVector& u) {
    const double length = rolling_length(w), moment = r.roll / length;
    const ContactVector f =
        rolling_natural_map(r, u, contact.friction, contact.rolling, 1.0 / w.nn, length);
    return {f.n * f.n + f.t * f.t + f.roll * f.roll, r.n * r.n + r.t * r.t + moment * moment};
}

inline ContactVector product(const Block& w, const ContactVector& r) {
    return in_plane(w.nn * r.n + w.nt * r.t + w.nr * r.roll,
                    w.nt * r.n + w.tt * r.t + w.tr * r.roll,
                    w.nr * r.n + w.tr * r.t + w.rr * r.roll);
}

inline ContactVector solution(const Contact& contact, const Block& w, const ContactVector& b) {
    if (w.film) return solve_filmed_contact(w, b, contact.friction, contact.rolling);
    return without_film(w, b, contact.friction, contact.rolling);
}

inline ContactVector carried_part(const Contact& contact, const Block& w, const ContactVector& r,
                                  const ContactVector& u) {
    return carried_part(w, u - product(w, r), contact.friction, contact.rolling);
}

/// Film and contact are no cone, so the measure is what one exact update of the contact alone would
/// change, |r - r*|^2, the moment over rolling_length().
inline MapTerms filmed_terms(const Contact& contact, const Block& w, const ContactVector& r,
                             const ContactVector& u) {
    const ContactVector next = solution(contact, w, u - product(w, r));
    const double shorter = w.rr > 0.0 ? 1.0 / rolling_length(w) : 0.0;
    const double fn = r.n - next.n, ft = r.t - next.t, fm = shorter * (r.roll - next.roll);
    const double moment = shorter * r.roll;
    return {fn * fn + ft * ft + fm * fm, r.n * r.n + r.t * r.t + moment * moment};
}

inline MapTerms map_terms(const Contact& contact, const Block& w, const ContactVector& r,
                          const ContactVector& u) {
    if (w.film) return filmed_terms(contact, w, r, u);
    if (w.rr > 0.0) return rolling_terms(contact, w, r, u);
    const Plane f = natural_map({r.n, r.t}, {u.n, u.t}, contact.friction, 1.0 / w.nn);
    return {f[0] * f[0] + f[1] * f[1], r.n * r.n + r.t * r.t};
}

inline double squared(const Block& w, const ContactVector& u) {
    const double rolling = w.rr > 0.0 ? u.roll * u.roll * (w.nn / w.rr) : 0.0;
    return u.n * u.n + u.t * u.t + rolling;
}

static_assert(ContactOperator<Delassus>);

}  // namespace turbidite::nscd
