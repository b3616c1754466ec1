// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Rolling resistance of discs: a moment up to mu_r R* r_n against the relative spin, R* the reduced
// radius of the pair (R at a wall). A disc on a plane that does not slide stays at rest iff the
// slope is at most mu_r.
#pragma once

#include "granular_adapter/nscd/laws/law.hpp"

namespace turbidite::nscd {

class RollingResistance final : public LawPart {
 public:
    RollingResistance(const LawSettings& settings, const SurfaceTable& surfaces);
    void add(const ContactSituation& situation, LawTerms& terms) const override;
    bool idle() const override { return idle_; }

 private:
    bool idle_;
};

}  // namespace turbidite::nscd
