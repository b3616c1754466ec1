// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/laws/static_dynamic.hpp"

#include <stdexcept>
#include <string>

namespace turbidite::nscd {
namespace {

constexpr double unknown = 0.0, stuck = 1.0, sliding = 2.0;

}  // namespace

StaticDynamic::StaticDynamic(const LawSettings&, const SurfaceTable& surfaces) {
    for (const Surface& pair : surfaces.all_pairs())
        if (!(pair.static_friction >= pair.friction))
            throw std::invalid_argument("static friction " + std::to_string(pair.static_friction) +
                                        " must not be below the friction of sliding contacts, " +
                                        std::to_string(pair.friction));
}

void StaticDynamic::add(const ContactSituation& situation, LawTerms& terms) const {
    const bool at_rest = situation.state == unknown && situation.approach[1] == 0.0;
    terms.friction = situation.state == stuck || at_rest ? situation.surface.static_friction
                                                         : situation.surface.friction;
}

double StaticDynamic::remember(const ContactSituation&, const ContactOutcome& outcome) const {
    if (!outcome.pressed()) return unknown;
    return outcome.sticks() ? stuck : sliding;
}

}  // namespace turbidite::nscd
