// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/laws/impact.hpp"

#include <algorithm>
#include <stdexcept>

namespace turbidite::nscd {

bool in_impact(const ContactSituation& s, double threshold) {
    return s.approach.n < -threshold && (touching(s) || s.gap + s.step * s.free.n <= 0.0);
}

void demand_rebound(const ContactSituation& s, double restitution, LawTerms& terms) {
    terms.normal_bias = std::min(terms.normal_bias, restitution * s.approach.n);
}

bool never_bounces(const SurfaceTable& surfaces) {
    const auto& pairs = surfaces.all_pairs();
    return std::all_of(pairs.begin(), pairs.end(), [](const Surface& pair) {
        return pair.restitution == 0.0 && pair.restitution_tangential == 0.0;
    });
}

double bounce_threshold(const LawSettings& settings) {
    if (settings.restitution_speed >= 0.0) return settings.restitution_speed;
    throw std::invalid_argument(
        "the approach speed below which contacts do not rebound must be zero or positive");
}

}  // namespace turbidite::nscd
