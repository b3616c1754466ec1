// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Mohr-Coulomb bonds with irreversible failure. Contacts closed to `adhesion_range` in the first
// step of a run are bonded; while a bond is intact
//
//     c = sigma_n l,   mu = sigma_t/sigma_n,   b_n = 0 across a gap (the bond keeps it)
//     c = sigma_n l^2 in space
//
// so that it bears traction up to c and, without normal load, shear up to mu c. It breaks in the
// step in which r~ leaves the interior of the cone, and leaves a dry contact for good. l is the
// length of the touching faces, shared by their points (a corner alone has no bond), or the smaller
// diameter if one body is round (the diameter at a wall); sigma_n = Surface::adhesion over the
// reference diameter, in space over its square.
#include <algorithm>

#include "granular_adapter/nscd/laws/adhesion_settings.hpp"
#include "granular_adapter/nscd/laws/law_list.hpp"

namespace turbidite::nscd {
namespace {

constexpr double broken = 0.0, intact = 1.0;

double bond_length(const ContactSituation& s) {
    if (!s.round) return s.length;
    return 2.0 * std::min(s.radius_a, s.radius_b);
}

/// c = sigma_n l, in space sigma_n l^2 [N].
double strength(const ContactSituation& s, const LawSettings& settings) {
    const double diameter = settings.reference_diameter, length = bond_length(s);
    const double in_plane = s.surface.adhesion / diameter * length;
    return settings.dimension == 3 ? in_plane * (length / diameter) : in_plane;
}

}  // namespace

std::optional<LawPart> make_cohesion(const LawSettings& settings, const SurfaceTable& surfaces) {
    const double range = settings.adhesion_range, shear = settings.adhesion_shear;
    demand_adhesion("cohesion", settings, surfaces);
    demand_positive("cohesion", "shear strength over traction", shear);
    const auto bonded = [range](const ContactSituation& s) {
        if (s.surface.adhesion == 0.0 || bond_length(s) == 0.0 || s.share == 0.0) return false;
        return s.state == intact || (s.initial && s.gap < range);
    };
    return LawPart{.add =
                       [=](const ContactSituation& s, LawTerms& terms) {
                           if (!bonded(s)) return;
                           terms.attraction = strength(s, settings);
                           terms.friction = shear;  // mu = sigma_t/sigma_n
                           terms.normal_bias = std::min(terms.normal_bias, 0.0);
                       },
                   .remember =
                       [bonded](const ContactSituation& s, const ContactOutcome& outcome) {
                           return bonded(s) && outcome.sticks() ? intact : broken;
                       },
                   .range = range};
}

}  // namespace turbidite::nscd
