// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/laws/contact_law.hpp"

#include <algorithm>

namespace turbidite::nscd {

ContactLaw::ContactLaw(const LawChoice& choice, const LawSettings& settings,
                       const SurfaceTable& surfaces, LawList laws) {
    const std::array<const std::string*, law_slots> names = {&choice.gap,      &choice.friction,
                                                             &choice.adhesion, &choice.film,
                                                             &choice.impact,   &choice.rolling};
    for (std::size_t slot = 0; slot < law_slots; ++slot) {
        std::optional<LawPart> law =
            make_law_part(static_cast<LawSlot>(slot), *names[slot], settings, surfaces, laws);
        if (!law) continue;
        remembers_ = remembers_ || law->remember;
        reads_velocities_ = reads_velocities_ || law->reads_velocities;
        range_ = std::max(range_, law->range);
        parts_.push_back({slot, std::move(*law)});
    }
}

LawTerms ContactLaw::terms(ContactSituation situation, const ContactState& state) const {
    LawTerms terms;
    // In the order of the slots: a bond replaces the friction, an impact needs the film and may
    // only demand a larger u_n than the gap does.
    for (const Part& part : parts_) {
        situation.state = state[part.slot];
        part.law.add(situation, terms);
    }
    return terms;
}

ContactState ContactLaw::remember(ContactSituation situation, const ContactState& state,
                                  const ContactOutcome& outcome) const {
    ContactState next{};
    for (const Part& part : parts_) {
        if (!part.law.remember) continue;
        situation.state = state[part.slot];
        next[part.slot] = part.law.remember(situation, outcome);
    }
    return next;
}

bool ContactLaw::has(LawSlot slot) const {
    return std::any_of(parts_.begin(), parts_.end(), [slot](const Part& part) {
        return part.slot == static_cast<std::size_t>(slot);
    });
}

}  // namespace turbidite::nscd
