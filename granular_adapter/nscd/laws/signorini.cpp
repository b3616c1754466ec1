// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The Signorini condition on gaps and velocities at once, without restitution.
//
//     g >= 0:  b_n = g/dt                                   contact at the end of the step at most
//     g <  0:  b_n = max(fraction g/dt, -recovery speed)    overlap is removed, but slowly: the
//                                                           full g/dt would act like an impact
#include <algorithm>
#include <stdexcept>
#include <string>

#include "granular_adapter/nscd/laws/law_list.hpp"

namespace turbidite::nscd {
namespace {

class Signorini final : public LawPart {
 public:
    /// Throws std::invalid_argument unless fraction is in [0, 1] and speed >= 0.
    Signorini(const LawSettings& settings, const SurfaceTable& surfaces);
    void add(const ContactSituation& situation, LawTerms& terms) const override;

 private:
    double fraction_;
    double speed_;
};

Signorini::Signorini(const LawSettings& settings, const SurfaceTable&)
    : fraction_(settings.recovery_fraction), speed_(settings.recovery_speed) {
    if (!(fraction_ >= 0.0 && fraction_ <= 1.0))
        throw std::invalid_argument("contact recovery fraction " + std::to_string(fraction_) +
                                    " must lie in [0, 1]");
    if (!(speed_ >= 0.0))
        throw std::invalid_argument("contact recovery speed must be zero or positive");
}

void Signorini::add(const ContactSituation& situation, LawTerms& terms) const {
    const double full = situation.gap / situation.step;
    terms.normal_bias = situation.gap >= 0.0 ? full : std::max(fraction_ * full, -speed_);
}

}  // namespace

std::unique_ptr<const LawPart> make_signorini(const LawSettings& settings,
                                              const SurfaceTable& surfaces) {
    return std::make_unique<Signorini>(settings, surfaces);
}

}  // namespace turbidite::nscd
