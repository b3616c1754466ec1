// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Rolling resistance of round grains: a moment of at most mu_r R* r_n opposing the relative spin,
// R* the reduced radius of the pair (R at a wall). A disc or sphere on an incline that does not
// slide stays at rest iff the slope is at most mu_r.
//
// In space this is the part of the moment in the tangent plane. Torsional resistance is the same
// about the normal, with a coefficient of its own; in the plane there is no such spin.
#include <algorithm>

#include "granular_adapter/nscd/laws/law_list.hpp"

namespace turbidite::nscd {

std::optional<LawPart> make_rolling_resistance(const LawSettings& settings,
                                               const SurfaceTable& surfaces) {
    const bool space = settings.dimension == 3;
    const auto& pairs = surfaces.all_pairs();
    if (std::all_of(pairs.begin(), pairs.end(), [space](const Surface& pair) {
            return pair.rolling_friction == 0.0 && (!space || pair.torsion_friction == 0.0);
        }))
        return std::nullopt;
    return LawPart{.add = [space](const ContactSituation& s, LawTerms& terms) {
        terms.rolling = s.surface.rolling_friction * reduced_radius(s);
        if (space) terms.torsion = s.surface.torsion_friction * reduced_radius(s);
    }};
}

}  // namespace turbidite::nscd
