// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A contact law, written as a change of variables: whatever the law, the solver sees
//
//     0 <= u_n + b_n  perp  r_n >= 0,   |r_t| <= mu r_n,   r_t opposite to u_t + b_t when sliding
//
// and the law says what b (bias, [m/s]) and mu are. A law costs nothing in the solver's loop.
#pragma once

namespace turbidite::nscd {

/// What a law may look at.
struct ContactSituation {
    double gap = 0.0;       ///< g(q) [m]
    double step = 0.0;      ///< dt [s]
    double friction = 0.0;  ///< mu of the two surfaces
};

struct LawTerms {
    double friction = 0.0;         ///< mu
    double normal_bias = 0.0;      ///< b_n [m/s]
    double tangential_bias = 0.0;  ///< b_t [m/s]
};

/// Parameters of all laws; each reads its own.
struct LawSettings {
    double recovery_fraction = 0.2;  ///< part of an overlap that one step takes back, [0, 1]
    double recovery_speed = 0.5;     ///< but never faster than this [m/s]
};

class ContactLaw {
 public:
    virtual ~ContactLaw() = default;
    virtual LawTerms terms(const ContactSituation& situation) const = 0;
};

}  // namespace turbidite::nscd
