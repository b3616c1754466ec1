// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Coulomb friction with two coefficients: the static one for a contact that stuck in the last step,
// or a new one without tangential motion; the sliding one for all others.
//
// The step in which a sticking contact begins to slide still has the static coefficient.
#include <stdexcept>
#include <string>

#include "granular_adapter/nscd/laws/law_list.hpp"

namespace turbidite::nscd {
namespace {

constexpr double unknown = 0.0, stuck = 1.0, sliding = 2.0;

void add(const ContactSituation& s, LawTerms& terms) {
    const bool at_rest = s.state == unknown && s.approach.t == 0.0;
    terms.friction = s.state == stuck || at_rest ? s.surface.static_friction : s.surface.friction;
}

double remember(const ContactSituation&, const ContactOutcome& outcome) {
    if (!outcome.pressed()) return unknown;
    return outcome.sticks() ? stuck : sliding;
}

}  // namespace

/// Static friction is given, and not below sliding friction.
std::optional<LawPart> make_static_dynamic(const LawSettings&, const SurfaceTable& surfaces) {
    for (const Surface& pair : surfaces.all_pairs())
        if (!(pair.static_friction >= pair.friction))
            throw std::invalid_argument("static friction " + std::to_string(pair.static_friction) +
                                        " must not be below the friction of sliding contacts, " +
                                        std::to_string(pair.friction));
    return LawPart{.add = add, .remember = remember, .reads_velocities = true};
}

}  // namespace turbidite::nscd
