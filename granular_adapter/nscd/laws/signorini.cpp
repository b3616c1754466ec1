// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The Signorini condition on gaps and velocities at once, without restitution.
//
//     g >= 0:  b_n = g/dt                                   contact at the end of the step at most
//     g <  0:  b_n = max(fraction g/dt, -recovery speed)    overlap is removed, but slowly: the
//                                                           full g/dt would act like an impact
#include <algorithm>
#include <stdexcept>
#include <string>

#include "granular_adapter/nscd/laws/law_list.hpp"

namespace turbidite::nscd {

/// Fraction in [0, 1], speed >= 0.
std::optional<LawPart> make_signorini(const LawSettings& settings, const SurfaceTable&) {
    const double fraction = settings.recovery_fraction, speed = settings.recovery_speed;
    if (!(fraction >= 0.0 && fraction <= 1.0))
        throw std::invalid_argument("contact recovery fraction " + std::to_string(fraction) +
                                    " must lie in [0, 1]");
    if (!(speed >= 0.0))
        throw std::invalid_argument("contact recovery speed must be zero or positive");
    return LawPart{.add = [=](const ContactSituation& s, LawTerms& terms) {
        const double full = s.gap / s.step;
        terms.normal_bias = s.gap >= 0.0 ? full : std::max(fraction * full, -speed);
    }};
}

}  // namespace turbidite::nscd
