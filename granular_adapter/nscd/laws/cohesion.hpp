// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Mohr-Coulomb bonds with irreversible breaking. Contacts that are closed to `adhesion_range` in
// the first step of a run are bonded; while a bond is intact
//
//     c = sigma_n l,   mu = sigma_t/sigma_n,   b_n = 0 at a gap (the bond keeps it)
//
// so that it carries traction up to c and, unloaded, shear up to mu c. It breaks in the step in
// which r~ leaves the inside of the cone, and leaves a dry contact for ever. l is the length of the
// faces that touch, shared by their points (a corner alone has no bond), or the smaller diameter
// where one is a disc (the diameter at a wall); sigma_n = Surface::adhesion over the reference
// diameter.
#pragma once

#include "granular_adapter/nscd/laws/law.hpp"

namespace turbidite::nscd {

class Cohesion final : public LawPart {
 public:
    /// Throws std::invalid_argument when adhesion, range or the strength in shear is missing.
    Cohesion(const LawSettings& settings, const SurfaceTable& surfaces);
    void add(const ContactSituation& situation, LawTerms& terms) const override;
    double remember(const ContactSituation& situation,
                    const ContactOutcome& outcome) const override;
    bool remembers() const override { return true; }
    double range() const override { return range_; }

 private:
    bool bonded(const ContactSituation& situation) const;

    double range_;
    double shear_;
    double diameter_;
};

}  // namespace turbidite::nscd
