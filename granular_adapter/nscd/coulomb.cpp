// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/coulomb.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace turbidite::nscd {

Coulomb::Coulomb(const LawSettings& settings) : settings_(settings) {
    if (!(settings.recovery_fraction >= 0.0 && settings.recovery_fraction <= 1.0))
        throw std::invalid_argument("contact recovery fraction " +
                                    std::to_string(settings.recovery_fraction) +
                                    " must lie in [0, 1]");
    if (!(settings.recovery_speed >= 0.0))
        throw std::invalid_argument("contact recovery speed must be zero or positive");
}

LawTerms Coulomb::terms(const ContactSituation& situation) const {
    const double full = situation.gap / situation.step;
    const double capped = std::max(settings_.recovery_fraction * full, -settings_.recovery_speed);
    return {situation.friction, situation.gap >= 0.0 ? full : capped, 0.0};
}

}  // namespace turbidite::nscd
