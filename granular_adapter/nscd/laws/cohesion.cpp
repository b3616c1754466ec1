// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Mohr-Coulomb bonds with irreversible failure. Contacts closed to `adhesion_range` in the first
// step of a run are bonded; while a bond is intact
//
//     c = sigma_n l,   mu = sigma_t/sigma_n,   b_n = 0 across a gap (the bond keeps it)
//
// so that it bears traction up to c and, without normal load, shear up to mu c. It breaks in the
// step in which r~ leaves the interior of the cone, and leaves a dry contact for good. l is the
// length of the touching faces, shared by their points (a corner alone has no bond), or the smaller
// diameter if one body is a disc (the diameter at a wall); sigma_n = Surface::adhesion over the
// reference diameter.
#include <algorithm>

#include "granular_adapter/nscd/laws/adhesion_settings.hpp"
#include "granular_adapter/nscd/laws/law_list.hpp"

namespace turbidite::nscd {
namespace {

class Cohesion final : public LawPart {
 public:
    /// Throws std::invalid_argument if adhesion, range or shear strength is missing.
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

constexpr double broken = 0.0, intact = 1.0;

double bond_length(const ContactSituation& situation) {
    if (!situation.round) return situation.length;
    return 2.0 * std::min(situation.radius_a, situation.radius_b);
}

Cohesion::Cohesion(const LawSettings& settings, const SurfaceTable& surfaces)
    : range_(settings.adhesion_range),
      shear_(settings.adhesion_shear),
      diameter_(settings.reference_diameter) {
    demand_adhesion("cohesion", settings, surfaces);
    demand_positive("cohesion", "shear strength over traction", shear_);
}

bool Cohesion::bonded(const ContactSituation& situation) const {
    if (situation.surface.adhesion == 0.0 || bond_length(situation) == 0.0) return false;
    return situation.state == intact || (situation.initial && situation.gap < range_);
}

void Cohesion::add(const ContactSituation& situation, LawTerms& terms) const {
    if (!bonded(situation)) return;
    terms.attraction = situation.surface.adhesion / diameter_ * bond_length(situation);
    terms.friction = shear_;
    terms.normal_bias = std::min(terms.normal_bias, 0.0);
}

double Cohesion::remember(const ContactSituation& situation, const ContactOutcome& outcome) const {
    return bonded(situation) && outcome.sticks() ? intact : broken;
}

}  // namespace

std::unique_ptr<const LawPart> make_cohesion(const LawSettings& settings,
                                             const SurfaceTable& surfaces) {
    return std::make_unique<Cohesion>(settings, surfaces);
}

}  // namespace turbidite::nscd
