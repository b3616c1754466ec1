// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Coulomb friction with one coefficient.
#include "granular_adapter/nscd/laws/law_list.hpp"

namespace turbidite::nscd {
namespace {

class Coulomb final : public LawPart {
 public:
    Coulomb(const LawSettings&, const SurfaceTable&) {}
    void add(const ContactSituation& situation, LawTerms& terms) const override {
        terms.friction = situation.surface.friction;
    }
};

}  // namespace

std::unique_ptr<const LawPart> make_coulomb(const LawSettings& settings,
                                            const SurfaceTable& surfaces) {
    return std::make_unique<Coulomb>(settings, surfaces);
}

}  // namespace turbidite::nscd
