// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/laws/cohesion.hpp"

#include <algorithm>

#include "granular_adapter/nscd/laws/adhesion_settings.hpp"

namespace turbidite::nscd {
namespace {

constexpr double broken = 0.0, intact = 1.0;

double bond_length(const ContactSituation& situation) {
    if (!situation.round) return situation.length;
    return 2.0 * std::min(situation.radius_a, situation.radius_b);
}

}  // namespace

Cohesion::Cohesion(const LawSettings& settings, const SurfaceTable& surfaces)
    : range_(settings.adhesion_range),
      shear_(settings.adhesion_shear),
      diameter_(settings.reference_diameter) {
    demand_adhesion("cohesion", settings, surfaces);
    demand_positive("cohesion", "shear strength over traction", shear_);
}

bool Cohesion::bonded(const ContactSituation& situation) const {
    if (situation.surface.adhesion == 0.0 || bond_length(situation) == 0.0) return false;
    return situation.state == intact || (situation.initial && situation.gap < range_);
}

void Cohesion::add(const ContactSituation& situation, LawTerms& terms) const {
    if (!bonded(situation)) return;
    terms.attraction = situation.surface.adhesion / diameter_ * bond_length(situation);
    terms.friction = shear_;
    terms.normal_bias = std::min(terms.normal_bias, 0.0);
}

double Cohesion::remember(const ContactSituation& situation, const ContactOutcome& outcome) const {
    return bonded(situation) && outcome.sticks() ? intact : broken;
}

}  // namespace turbidite::nscd
