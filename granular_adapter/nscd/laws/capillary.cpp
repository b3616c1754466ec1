// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Liquid bridges (after Richefeu et al. 2006): form on contact, break at the rupture distance
// adhesion_range, and attract with
//
//     c(g) = kappa sqrt(R1 R2) exp(-g/lambda),   c(0) for overlapping bodies
//
// lambda = adhesion_length. At a wall sqrt(R1 R2) is replaced by 2 R, Derjaguin's approximation for
// a plane. kappa is Surface::adhesion over the reference radius. The points of a pair share the
// force; R of a polygon is its circumscribed radius.
#include <algorithm>
#include <cmath>

#include "granular_adapter/nscd/laws/adhesion_settings.hpp"
#include "granular_adapter/nscd/laws/law_list.hpp"

namespace turbidite::nscd {
namespace {

class Capillary final : public LawPart {
 public:
    /// Throws std::invalid_argument if adhesion, range or length is missing.
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
    double radius_;  ///< reference radius [m]
};

constexpr double none = 0.0, bridge = 1.0;

double effective_radius(const ContactSituation& situation) {
    if (std::isinf(situation.radius_a)) return 2.0 * situation.radius_b;
    return std::sqrt(situation.radius_a * situation.radius_b);
}

Capillary::Capillary(const LawSettings& settings, const SurfaceTable& surfaces)
    : range_(settings.adhesion_range),
      length_(settings.adhesion_length),
      radius_(0.5 * settings.reference_diameter) {
    demand_adhesion("capillary", settings, surfaces);
    demand_positive("capillary", "decay length", length_);
}

bool Capillary::bridged(const ContactSituation& situation) const {
    return situation.gap < range_ && (situation.state == bridge || touching(situation));
}

void Capillary::add(const ContactSituation& situation, LawTerms& terms) const {
    if (!bridged(situation)) return;
    // adhesion/R_ref, shared by the points
    const double kappa = situation.share * situation.surface.adhesion / radius_;
    // c(g) = kappa sqrt(R1 R2) exp(-g/lambda)
    terms.attraction =
        kappa * effective_radius(situation) * std::exp(-std::max(situation.gap, 0.0) / length_);
}

double Capillary::remember(const ContactSituation& situation, const ContactOutcome& outcome) const {
    return bridged(situation) || outcome.pressed() ? bridge : none;
}

}  // namespace

std::unique_ptr<const LawPart> make_capillary(const LawSettings& settings,
                                              const SurfaceTable& surfaces) {
    return std::make_unique<Capillary>(settings, surfaces);
}

}  // namespace turbidite::nscd
