// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Dry friction with two coefficients: the static one for a contact that stuck in the last step, or
// that is new and does not move along the tangent; the sliding one for all others.
//
// The step in which a stuck contact gives way still has the static coefficient.
#pragma once

#include "granular_adapter/nscd/laws/law.hpp"

namespace turbidite::nscd {

class StaticDynamic final : public LawPart {
 public:
    /// Throws std::invalid_argument where static friction is missing or below that of sliding.
    StaticDynamic(const LawSettings& settings, const SurfaceTable& surfaces);
    void add(const ContactSituation& situation, LawTerms& terms) const override;
    double remember(const ContactSituation& situation,
                    const ContactOutcome& outcome) const override;
    bool remembers() const override { return true; }
    bool reads_velocities() const override { return true; }
};

}  // namespace turbidite::nscd
