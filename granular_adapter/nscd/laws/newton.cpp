// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/laws/newton.hpp"

#include "granular_adapter/nscd/laws/impact.hpp"

namespace turbidite::nscd {

Newton::Newton(const LawSettings& settings, const SurfaceTable& surfaces)
    : threshold_(bounce_threshold(settings)), idle_(never_bounces(surfaces)) {}

void Newton::add(const ContactSituation& situation, LawTerms& terms) const {
    if (!in_impact(situation, threshold_)) return;
    if (situation.surface.restitution > 0.0)
        demand_rebound(situation, situation.surface.restitution, terms);
    terms.tangential_bias += situation.surface.restitution_tangential * situation.approach[1];
}

}  // namespace turbidite::nscd
