// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Signorini on gaps and velocities at once, without restitution.
//
//     g >= 0:  b_n = g/dt                                   contact at the end of the step at most
//     g <  0:  b_n = max(fraction g/dt, -recovery speed)    overlap is taken back, but slowly: the
//                                                           full g/dt would be a kick
#pragma once

#include "granular_adapter/nscd/laws/law.hpp"

namespace turbidite::nscd {

class Signorini final : public LawPart {
 public:
    /// Throws std::invalid_argument unless fraction is in [0, 1] and speed >= 0.
    Signorini(const LawSettings& settings, const SurfaceTable& surfaces);
    void add(const ContactSituation& situation, LawTerms& terms) const override;

 private:
    double fraction_;
    double speed_;
};

}  // namespace turbidite::nscd
