// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/laws/moreau.hpp"

#include <stdexcept>

#include "granular_adapter/nscd/laws/impact.hpp"

namespace turbidite::nscd {

Moreau::Moreau(const LawSettings& settings, const SurfaceTable& surfaces)
    : threshold_(bounce_threshold(settings)), idle_(never_bounces(surfaces)) {
    for (const Surface& pair : surfaces.all_pairs())
        if (pair.restitution_tangential > 0.0)
            throw std::invalid_argument(
                "contact law \"moreau\" has one restitution for both directions: the tangential "
                "one must be zero");
}

void Moreau::add(const ContactSituation& situation, LawTerms& terms) const {
    const double restitution = situation.surface.restitution;
    if (restitution == 0.0 || !in_impact(situation, threshold_)) return;
    demand_rebound(situation, restitution, terms);
    terms.tangential_bias += restitution * situation.approach[1];
}

}  // namespace turbidite::nscd
