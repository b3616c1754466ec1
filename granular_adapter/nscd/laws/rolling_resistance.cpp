// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Rolling resistance of discs: a moment of at most mu_r R* r_n opposing the relative spin, R* the
// reduced radius of the pair (R at a wall). A disc on an incline that does not slide stays at rest
// iff the slope is at most mu_r.
#include <algorithm>

#include "granular_adapter/nscd/laws/law_list.hpp"

namespace turbidite::nscd {

std::optional<LawPart> make_rolling_resistance(const LawSettings&, const SurfaceTable& surfaces) {
    const auto& pairs = surfaces.all_pairs();
    if (std::all_of(pairs.begin(), pairs.end(),
                    [](const Surface& pair) { return pair.rolling_friction == 0.0; }))
        return std::nullopt;
    return LawPart{.add = [](const ContactSituation& s, LawTerms& terms) {
        terms.rolling = s.surface.rolling_friction * reduced_radius(s);
    }};
}

}  // namespace turbidite::nscd
