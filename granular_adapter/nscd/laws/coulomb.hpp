// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Dry friction with one coefficient.
#pragma once

#include "granular_adapter/nscd/laws/law.hpp"

namespace turbidite::nscd {

class Coulomb final : public LawPart {
 public:
    Coulomb(const LawSettings&, const SurfaceTable&) {}
    void add(const ContactSituation& situation, LawTerms& terms) const override {
        terms.friction = situation.surface.friction;
    }
};

}  // namespace turbidite::nscd
