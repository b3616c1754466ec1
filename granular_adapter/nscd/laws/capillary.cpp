// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/laws/capillary.hpp"

#include <algorithm>
#include <cmath>

#include "granular_adapter/nscd/laws/adhesion_settings.hpp"

namespace turbidite::nscd {
namespace {

constexpr double none = 0.0, bridge = 1.0;

double effective_radius(const ContactSituation& situation) {
    if (std::isinf(situation.radius_a)) return 2.0 * situation.radius_b;
    return std::sqrt(situation.radius_a * situation.radius_b);
}

}  // namespace

Capillary::Capillary(const LawSettings& settings, const SurfaceTable& surfaces)
    : range_(settings.adhesion_range),
      length_(settings.adhesion_length),
      radius_(0.5 * settings.reference_diameter) {
    demand_adhesion("capillary", settings, surfaces);
    demand_positive("capillary", "decay length", length_);
}

bool Capillary::bridged(const ContactSituation& situation) const {
    return situation.gap < range_ && (situation.state == bridge || touching(situation));
}

void Capillary::add(const ContactSituation& situation, LawTerms& terms) const {
    if (!bridged(situation)) return;
    const double kappa = situation.share * situation.surface.adhesion / radius_;
    terms.attraction =
        kappa * effective_radius(situation) * std::exp(-std::max(situation.gap, 0.0) / length_);
}

double Capillary::remember(const ContactSituation& situation, const ContactOutcome& outcome) const {
    return bridged(situation) || outcome.pressed() ? bridge : none;
}

}  // namespace turbidite::nscd
