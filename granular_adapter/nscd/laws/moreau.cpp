// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Moreau's impact law: Signorini and Coulomb hold for the averaged velocity
//
//     u_a = (u^+ + e u^-)/(1 + e),   so   b_n = min(b_n, e u_n^-),   b_t = e u_t^-
//
// and moments oppose the averaged relative spin, with the bias e w^-,
//
// in impacts only; where a contact parts, b_n >= e u_n^- (impact.hpp). If all contacts of a step
// have the same e, impacts cannot increase the energy, with any friction and any number of
// contacts: r . u_a <= 0 and W positive give r . (u^+ + u^-) <= 0.
#include <stdexcept>

#include "granular_adapter/nscd/laws/impact.hpp"
#include "granular_adapter/nscd/laws/law_list.hpp"

namespace turbidite::nscd {

/// No surface has a tangential restitution of its own.
std::optional<LawPart> make_moreau(const LawSettings& settings, const SurfaceTable& surfaces) {
    const double threshold = bounce_threshold(settings);
    for (const Surface& pair : surfaces.all_pairs())
        if (pair.restitution_tangential > 0.0)
            throw std::invalid_argument(
                "contact law \"moreau\" has one restitution for both directions: the tangential "
                "one must be zero");
    if (never_bounces(surfaces)) return std::nullopt;
    return LawPart{.add =
                       [=](const ContactSituation& s, LawTerms& terms) {
                           const double restitution = s.surface.restitution;
                           if (restitution == 0.0) return;
                           if (!in_impact(s, terms, threshold))
                               return allow_return(s, restitution, threshold, terms);
                           demand_rebound(s, restitution, terms);
                           end_approach(terms);  // of a film that takes all of the rebound
                           terms.tangential_restitution = restitution;  // b_t = e u_t^-
                           terms.rolling_restitution = restitution;     // e w^-
                       },
                   .reads_velocities = true};
}

}  // namespace turbidite::nscd
