// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Liquid bridges (after Richefeu et al. 2006): form on contact, break at the rupture distance
// adhesion_range, and pull with
//
//     c(g) = kappa sqrt(R1 R2) exp(-g/lambda),   c(0) where the bodies overlap
//
// lambda = adhesion_length. At a wall 2 R stands for sqrt(R1 R2), as Derjaguin's approximation has
// it for a plane. kappa is Surface::adhesion over the reference radius. Points of a pair share the
// force; the R of a polygon is that of its circumscribed circle.
#pragma once

#include "granular_adapter/nscd/laws/law.hpp"

namespace turbidite::nscd {

class Capillary final : public LawPart {
 public:
    /// Throws std::invalid_argument when adhesion, range or length is missing.
    Capillary(const LawSettings& settings, const SurfaceTable& surfaces);
    void add(const ContactSituation& situation, LawTerms& terms) const override;
    double remember(const ContactSituation& situation,
                    const ContactOutcome& outcome) const override;
    bool remembers() const override { return true; }
    double range() const override { return range_; }

 private:
    bool bridged(const ContactSituation& situation) const;

    double range_;
    double length_;
    double radius_;  ///< of reference
};

}  // namespace turbidite::nscd
