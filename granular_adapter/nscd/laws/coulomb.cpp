// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Coulomb friction with one coefficient.
#include "granular_adapter/nscd/laws/law_list.hpp"

namespace turbidite::nscd {

std::optional<LawPart> make_coulomb(const LawSettings&, const SurfaceTable&) {
    return LawPart{.add = [](const ContactSituation& s, LawTerms& terms) {
        terms.friction = s.surface.friction;
    }};
}

}  // namespace turbidite::nscd
