// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Moreau's impact law: Signorini and Coulomb hold for the averaged velocity
//
//     u_a = (u^+ + e u^-)/(1 + e),   so   b_n = min(b_n, e u_n^-),   b_t = e u_t^-
//
// in impacts only. If all impacts of a step have the same e, the energy cannot increase, with any
// friction and any number of contacts: r . u_a <= 0 and W positive give r . (u^+ + u^-) <= 0.
#include <stdexcept>

#include "granular_adapter/nscd/laws/impact.hpp"
#include "granular_adapter/nscd/laws/law_list.hpp"

namespace turbidite::nscd {
namespace {

class Moreau final : public LawPart {
 public:
    /// Throws std::invalid_argument unless the threshold is >= 0, and if a surface has a tangential
    /// restitution of its own.
    Moreau(const LawSettings& settings, const SurfaceTable& surfaces);
    void add(const ContactSituation& situation, LawTerms& terms) const override;
    bool reads_velocities() const override { return true; }
    bool idle() const override { return idle_; }

 private:
    double threshold_;
    bool idle_;
};

Moreau::Moreau(const LawSettings& settings, const SurfaceTable& surfaces)
    : threshold_(bounce_threshold(settings)), idle_(never_bounces(surfaces)) {
    for (const Surface& pair : surfaces.all_pairs())
        if (pair.restitution_tangential > 0.0)
            throw std::invalid_argument(
                "contact law \"moreau\" has one restitution for both directions: the tangential "
                "one must be zero");
}

void Moreau::add(const ContactSituation& situation, LawTerms& terms) const {
    const double restitution = situation.surface.restitution;
    if (restitution == 0.0 || !in_impact(situation, threshold_)) return;
    demand_rebound(situation, restitution, terms);
    terms.tangential_restitution = restitution;  // b_t = e u_t^-
}

}  // namespace

std::unique_ptr<const LawPart> make_moreau(const LawSettings& settings,
                                           const SurfaceTable& surfaces) {
    return std::make_unique<Moreau>(settings, surfaces);
}

}  // namespace turbidite::nscd
