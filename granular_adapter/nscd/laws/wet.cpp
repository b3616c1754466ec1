// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A constant attraction c = Surface::adhesion within a distance, g < adhesion_range, shared by the
// points of a pair.
//
//     wet                at any gap below the distance
//     wet-irreversible   contacts within the distance in the first step, until they leave it
#include "granular_adapter/nscd/laws/adhesion_settings.hpp"
#include "granular_adapter/nscd/laws/law_list.hpp"

namespace turbidite::nscd {
namespace {

constexpr double dry = 0.0, wetted = 1.0;

double pull(const ContactSituation& s) {
    return s.share * s.surface.adhesion;
}

}  // namespace

std::optional<LawPart> make_wet(const LawSettings& settings, const SurfaceTable& surfaces) {
    demand_adhesion("wet", settings, surfaces);
    return LawPart{
        .add =
            [range = settings.adhesion_range](const ContactSituation& s, LawTerms& terms) {
                if (s.gap < range) terms.attraction = pull(s);
            },
        .range = settings.adhesion_range};
}

std::optional<LawPart> make_wet_irreversible(const LawSettings& settings,
                                             const SurfaceTable& surfaces) {
    demand_adhesion("wet-irreversible", settings, surfaces);
    const auto wet = [range = settings.adhesion_range](const ContactSituation& s) {
        return s.gap < range && (s.state == wetted || s.initial);
    };
    return LawPart{.add =
                       [wet](const ContactSituation& s, LawTerms& terms) {
                           if (wet(s)) terms.attraction = pull(s);
                       },
                   .remember = [wet](const ContactSituation& s,
                                     const ContactOutcome&) { return wet(s) ? wetted : dry; },
                   .range = settings.adhesion_range};
}

}  // namespace turbidite::nscd
