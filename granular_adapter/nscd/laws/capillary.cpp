// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Liquid bridges (after Richefeu et al. 2006): form on contact, break at the rupture distance
// adhesion_range, and attract with
//
//     c(g) = kappa sqrt(R1 R2) exp(-g/lambda),   c(0) for overlapping bodies
//
// lambda = adhesion_length. At a wall sqrt(R1 R2) is replaced by 2 R, Derjaguin's approximation for
// a plane. kappa is Surface::adhesion over the reference radius. The points of a pair share the
// force; R of a polygon is its circumscribed radius.
#include <algorithm>
#include <cmath>

#include "granular_adapter/nscd/laws/adhesion_settings.hpp"
#include "granular_adapter/nscd/laws/law_list.hpp"

namespace turbidite::nscd {
namespace {

constexpr double none = 0.0, bridge = 1.0;

double effective_radius(const ContactSituation& s) {
    if (std::isinf(s.radius_a)) return 2.0 * s.radius_b;
    return std::sqrt(s.radius_a * s.radius_b);
}

}  // namespace

std::optional<LawPart> make_capillary(const LawSettings& settings, const SurfaceTable& surfaces) {
    const double range = settings.adhesion_range, length = settings.adhesion_length;
    demand_adhesion("capillary", settings, surfaces);
    demand_positive("capillary", "decay length", length);
    const auto bridged = [range](const ContactSituation& s) {
        return s.gap < range && (s.state == bridge || touching(s));
    };
    return LawPart{.add =
                       [=, radius = 0.5 * settings.reference_diameter](const ContactSituation& s,
                                                                       LawTerms& terms) {
                           if (!bridged(s)) return;
                           // adhesion/R_ref, shared by the points
                           const double kappa = s.share * s.surface.adhesion / radius;
                           // c(g) = kappa sqrt(R1 R2) exp(-g/lambda)
                           terms.attraction = kappa * effective_radius(s) *
                                              std::exp(-std::max(s.gap, 0.0) / length);
                       },
                   .remember =
                       [bridged](const ContactSituation& s, const ContactOutcome& outcome) {
                           return bridged(s) || outcome.pressed() ? bridge : none;
                       },
                   .range = range};
}

}  // namespace turbidite::nscd
