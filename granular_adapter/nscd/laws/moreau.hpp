// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Moreau's impact law: Signorini and Coulomb hold for the averaged velocity
//
//     u_a = (u^+ + e u^-)/(1 + e),   so   b_n = min(b_n, e u_n^-),   b_t = e u_t^-
//
// in impacts. Where all impacts of a step have the same e the energy cannot grow, with any friction
// and any number of contacts: r . u_a <= 0 and W positive give r . (u^+ + u^-) <= 0.
#pragma once

#include "granular_adapter/nscd/laws/law.hpp"

namespace turbidite::nscd {

class Moreau final : public LawPart {
 public:
    /// Throws std::invalid_argument unless the threshold is >= 0, or when a surface has a
    /// tangential restitution of its own.
    Moreau(const LawSettings& settings, const SurfaceTable& surfaces);
    void add(const ContactSituation& situation, LawTerms& terms) const override;
    bool reads_velocities() const override { return true; }
    bool idle() const override { return idle_; }

 private:
    double threshold_;
    bool idle_;
};

}  // namespace turbidite::nscd
