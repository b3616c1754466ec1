// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Rolling resistance of discs: a moment of at most mu_r R* r_n opposing the relative spin, R* the
// reduced radius of the pair (R at a wall). A disc on an incline that does not slide stays at rest
// iff the slope is at most mu_r.
#include <algorithm>

#include "granular_adapter/nscd/laws/law_list.hpp"

namespace turbidite::nscd {
namespace {

class RollingResistance final : public LawPart {
 public:
    RollingResistance(const LawSettings& settings, const SurfaceTable& surfaces);
    void add(const ContactSituation& situation, LawTerms& terms) const override;
    bool idle() const override { return idle_; }

 private:
    bool idle_;
};

RollingResistance::RollingResistance(const LawSettings&, const SurfaceTable& surfaces)
    : idle_(std::all_of(surfaces.all_pairs().begin(), surfaces.all_pairs().end(),
                        [](const Surface& pair) { return pair.rolling_friction == 0.0; })) {}

void RollingResistance::add(const ContactSituation& situation, LawTerms& terms) const {
    terms.rolling = situation.surface.rolling_friction * reduced_radius(situation);
}

}  // namespace

std::unique_ptr<const LawPart> make_rolling_resistance(const LawSettings& settings,
                                                       const SurfaceTable& surfaces) {
    return std::make_unique<RollingResistance>(settings, surfaces);
}

}  // namespace turbidite::nscd
