// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Newton's impact law: u_n^+ = -e u_n^- for a loaded contact, u_t^+ = -e_t u_t^- if it does not
// slide; in impacts only (of contacts that part: impact.hpp). As a change of variables
//
//     b_n = min(b_n, e u_n^-),   b_t = e_t u_t^-
//
// With friction and several contacts, different e and e_t do not bound the energy in all cases;
// Moreau's law does.
#include "granular_adapter/nscd/laws/impact.hpp"
#include "granular_adapter/nscd/laws/law_list.hpp"

namespace turbidite::nscd {

std::optional<LawPart> make_newton(const LawSettings& settings, const SurfaceTable& surfaces) {
    const double threshold = bounce_threshold(settings);
    if (never_bounces(surfaces)) return std::nullopt;
    return LawPart{.add =
                       [=](const ContactSituation& s, LawTerms& terms) {
                           if (!in_impact(s, terms, threshold))
                               return allow_return(s, s.surface.restitution, threshold, terms);
                           if (s.surface.restitution > 0.0)
                               demand_rebound(s, s.surface.restitution, terms);
                           if (s.surface.restitution_tangential == 0.0) return;
                           end_approach(terms);
                           terms.tangential_restitution = s.surface.restitution_tangential;
                       },
                   .reads_velocities = true};
}

}  // namespace turbidite::nscd
