// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The contact law of a run: one part per slot, chosen by name, applied in the order of the slots.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "granular_adapter/nscd/laws/law_list.hpp"

namespace turbidite::nscd {

/// One name per slot, from law_list.
struct LawChoice {
    std::string gap = "signorini";
    std::string friction = "coulomb";
    std::string adhesion = "none";
    std::string film = "none";
    std::string impact = "newton";
    std::string rolling = "resistance";
};

/// The state of a contact's parts, by slot; all zero means no state.
using ContactState = std::array<double, law_slots>;

class ContactLaw {
 public:
    /// Looks the names up in `laws`. Throws std::invalid_argument for unknown names and for
    /// parameters that are missing or out of range.
    ContactLaw(const LawChoice& choice, const LawSettings& settings, const SurfaceTable& surfaces,
               LawList laws = law_list());

    /// The terms of a contact: the sum over all parts, in the order of the slots.
    LawTerms terms(ContactSituation situation, const ContactState& state) const;
    /// The contact's state for the next step.
    ContactState remember(ContactSituation situation, const ContactState& state,
                          const ContactOutcome& outcome) const;

    /// Whether the slot has a part that can act.
    bool has(LawSlot slot) const;
    bool remembers() const { return remembers_; }
    bool reads_velocities() const { return reads_velocities_; }
    double range() const { return range_; }  ///< largest range of all parts [m]

 private:
    struct Part {
        std::size_t slot;
        LawPart law;
    };
    std::vector<Part> parts_;
    bool remembers_ = false;
    bool reads_velocities_ = false;
    double range_ = 0.0;
};

}  // namespace turbidite::nscd
