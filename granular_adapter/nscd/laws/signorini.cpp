// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/laws/signorini.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace turbidite::nscd {

Signorini::Signorini(const LawSettings& settings, const SurfaceTable&)
    : fraction_(settings.recovery_fraction), speed_(settings.recovery_speed) {
    if (!(fraction_ >= 0.0 && fraction_ <= 1.0))
        throw std::invalid_argument("contact recovery fraction " + std::to_string(fraction_) +
                                    " must lie in [0, 1]");
    if (!(speed_ >= 0.0))
        throw std::invalid_argument("contact recovery speed must be zero or positive");
}

void Signorini::add(const ContactSituation& situation, LawTerms& terms) const {
    const double full = situation.gap / situation.step;
    terms.normal_bias = situation.gap >= 0.0 ? full : std::max(fraction_ * full, -speed_);
}

}  // namespace turbidite::nscd
