// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Signorini-Coulomb: no restitution, dry friction.
//
//     g >= 0:  b_n = g/dt                                     contact at the end of the step at
//     most g <  0:  b_n = max(fraction g/dt, -recovery speed)      overlap is taken back, but
//     slowly:
//                                                             the full g/dt would be a kick
#pragma once

#include "granular_adapter/nscd/law.hpp"

namespace turbidite::nscd {

class Coulomb final : public ContactLaw {
 public:
    /// Throws std::invalid_argument unless fraction is in [0, 1] and speed >= 0.
    explicit Coulomb(const LawSettings& settings);
    LawTerms terms(const ContactSituation& situation) const override;

 private:
    LawSettings settings_;
};

}  // namespace turbidite::nscd
