// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Newton's impact law: u_n^+ = -e u_n^- for a loaded contact, u_t^+ = -e_t u_t^- if it does not
// slide; in impacts only. As a change of variables
//
//     b_n = min(b_n, e u_n^-),   b_t = e_t u_t^-
//
// With friction and several contacts, different e and e_t do not bound the energy in all cases;
// Moreau's law does.
#include "granular_adapter/nscd/laws/impact.hpp"
#include "granular_adapter/nscd/laws/law_list.hpp"

namespace turbidite::nscd {
namespace {

class Newton final : public LawPart {
 public:
    /// Throws std::invalid_argument unless the threshold is >= 0.
    Newton(const LawSettings& settings, const SurfaceTable& surfaces);
    void add(const ContactSituation& situation, LawTerms& terms) const override;
    bool reads_velocities() const override { return true; }
    bool idle() const override { return idle_; }

 private:
    double threshold_;
    bool idle_;
};

Newton::Newton(const LawSettings& settings, const SurfaceTable& surfaces)
    : threshold_(bounce_threshold(settings)), idle_(never_bounces(surfaces)) {}

void Newton::add(const ContactSituation& situation, LawTerms& terms) const {
    if (!in_impact(situation, threshold_)) return;
    if (situation.surface.restitution > 0.0)
        demand_rebound(situation, situation.surface.restitution, terms);
    terms.tangential_restitution = situation.surface.restitution_tangential;
}

}  // namespace

std::unique_ptr<const LawPart> make_newton(const LawSettings& settings,
                                           const SurfaceTable& surfaces) {
    return std::make_unique<Newton>(settings, surfaces);
}

}  // namespace turbidite::nscd
