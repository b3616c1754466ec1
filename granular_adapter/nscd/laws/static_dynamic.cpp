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

class StaticDynamic final : public LawPart {
 public:
    /// Throws std::invalid_argument if static friction is missing or below sliding friction.
    StaticDynamic(const LawSettings& settings, const SurfaceTable& surfaces);
    void add(const ContactSituation& situation, LawTerms& terms) const override;
    double remember(const ContactSituation& situation,
                    const ContactOutcome& outcome) const override;
    bool remembers() const override { return true; }
    bool reads_velocities() const override { return true; }
};

constexpr double unknown = 0.0, stuck = 1.0, sliding = 2.0;

StaticDynamic::StaticDynamic(const LawSettings&, const SurfaceTable& surfaces) {
    for (const Surface& pair : surfaces.all_pairs())
        if (!(pair.static_friction >= pair.friction))
            throw std::invalid_argument("static friction " + std::to_string(pair.static_friction) +
                                        " must not be below the friction of sliding contacts, " +
                                        std::to_string(pair.friction));
}

void StaticDynamic::add(const ContactSituation& situation, LawTerms& terms) const {
    const bool at_rest = situation.state == unknown && situation.approach.t == 0.0;
    terms.friction = situation.state == stuck || at_rest ? situation.surface.static_friction
                                                         : situation.surface.friction;
}

double StaticDynamic::remember(const ContactSituation&, const ContactOutcome& outcome) const {
    if (!outcome.pressed()) return unknown;
    return outcome.sticks() ? stuck : sliding;
}

}  // namespace

std::unique_ptr<const LawPart> make_static_dynamic(const LawSettings& settings,
                                                   const SurfaceTable& surfaces) {
    return std::make_unique<StaticDynamic>(settings, surfaces);
}

}  // namespace turbidite::nscd
