// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/laws/wet.hpp"

#include "granular_adapter/nscd/laws/adhesion_settings.hpp"

namespace turbidite::nscd {
namespace {

constexpr double dry = 0.0, wetted = 1.0;

double pull(const ContactSituation& situation) {
    return situation.share * situation.surface.adhesion;
}

}  // namespace

Wet::Wet(const LawSettings& settings, const SurfaceTable& surfaces)
    : range_(settings.adhesion_range) {
    demand_adhesion("wet", settings, surfaces);
}

void Wet::add(const ContactSituation& situation, LawTerms& terms) const {
    if (situation.gap < range_) terms.attraction = pull(situation);
}

WetOnce::WetOnce(const LawSettings& settings, const SurfaceTable& surfaces)
    : range_(settings.adhesion_range) {
    demand_adhesion("wet-irreversible", settings, surfaces);
}

bool WetOnce::wet(const ContactSituation& situation) const {
    return situation.gap < range_ && (situation.state == wetted || situation.initial);
}

void WetOnce::add(const ContactSituation& situation, LawTerms& terms) const {
    if (wet(situation)) terms.attraction = pull(situation);
}

double WetOnce::remember(const ContactSituation& situation, const ContactOutcome&) const {
    return wet(situation) ? wetted : dry;
}

}  // namespace turbidite::nscd
