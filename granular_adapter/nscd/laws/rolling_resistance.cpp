// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/laws/rolling_resistance.hpp"

#include <algorithm>

namespace turbidite::nscd {

RollingResistance::RollingResistance(const LawSettings&, const SurfaceTable& surfaces)
    : idle_(std::all_of(surfaces.all_pairs().begin(), surfaces.all_pairs().end(),
                        [](const Surface& pair) { return pair.rolling_friction == 0.0; })) {}

void RollingResistance::add(const ContactSituation& situation, LawTerms& terms) const {
    terms.rolling = situation.surface.rolling_friction * reduced_radius(situation);
}

}  // namespace turbidite::nscd
