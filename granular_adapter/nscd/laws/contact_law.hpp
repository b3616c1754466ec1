// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The law of a run: one part per slot, chosen by name, asked in the order of the slots.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "granular_adapter/nscd/laws/law_list.hpp"

namespace turbidite::nscd {

/// Names of law_list, one per slot.
struct LawChoice {
    std::string gap = "signorini";
    std::string friction = "coulomb";
    std::string adhesion = "none";
    std::string impact = "newton";
    std::string rolling = "resistance";
};

/// What the parts remember of a contact, by slot; all zero: nothing.
using ContactState = std::array<double, law_slots>;

class ContactLaw {
 public:
    /// Names are looked up in `laws`. Throws std::invalid_argument on unknown ones and on
    /// parameters that are missing or out of range.
    ContactLaw(const LawChoice& choice, const LawSettings& settings, const SurfaceTable& surfaces,
               LawList laws = law_list());

    LawTerms terms(ContactSituation situation, const ContactState& state) const;
    ContactState remember(ContactSituation situation, const ContactState& state,
                          const ContactOutcome& outcome) const;

    bool has(LawSlot slot) const;
    bool remembers() const { return remembers_; }
    bool reads_velocities() const { return reads_velocities_; }
    double range() const { return range_; }

 private:
    struct Part {
        std::size_t slot;
        std::shared_ptr<const LawPart> law;
    };
    std::vector<Part> parts_;
    bool remembers_ = false;
    bool reads_velocities_ = false;
    double range_ = 0.0;
};

}  // namespace turbidite::nscd
