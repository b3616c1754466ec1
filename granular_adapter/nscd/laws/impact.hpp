// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Whether a contact undergoes an impact in a step, and how restitution enters its bias.
//
// A body that would meet another within the step rebounds at once, up to |u| dt before they touch.
// So nothing overlaps, and the velocities are those of the impact law whatever the gap was.
#pragma once

#include "granular_adapter/nscd/laws/law.hpp"

namespace turbidite::nscd {

/// What a film takes of the speed between the gap and touching: the integral over the gap of
///     m dv = -C (1/g_h - 1/g_c) dg,   between discs -C (g_h^{-3/2} - g_c^{-3/2}) dg,   1/m = W_nn
/// Zero without a film [m/s].
double speed_lost(const ContactSituation& situation, const FilmTerms& film);

/// u_n^-; with a film what it leaves of an approach by the time the surfaces touch, zero if they do
/// not get there [m/s].
double approach_at_touch(const ContactSituation& situation, const FilmTerms& film);

/// The approach is faster than `threshold`, and the contact is closed or closes within the step.
bool in_impact(const ContactSituation& situation, const LawTerms& terms, double threshold);

/// Imposes u_n >= -e u_n^-, less what a film takes, unless the terms already require more.
void demand_rebound(const ContactSituation& situation, double restitution, LawTerms& terms);

/// A contact that parts faster than `threshold` may close again at e u_n^-: b_n >= e u_n^-. An
/// impact on the other side of a body throws it back at once, and this contact, if its gap g is
/// smaller than that, would have to throw it forward: no velocity meets both, or another body gets
/// energy that nobody had. With r_n >= 0 this b_n gives r_n (u_n^+ + e u_n^-) <= 0, the bound of
/// the energy in impacts. What overlaps then, up to e u_n^- dt - g, is an impact of the next step.
void allow_return(const ContactSituation& situation, double restitution, double threshold,
                  LawTerms& terms);

/// Imposes u_n >= 0 as well where there is no rebound: else what closes the gap in this step would
/// be an impact again in the next, and a tangential restitution would act twice.
void end_approach(LawTerms& terms);

/// True if no pair of surfaces has a restitution coefficient above zero.
bool never_bounces(const SurfaceTable& surfaces);

/// LawSettings::restitution_speed; throws std::invalid_argument unless it is >= 0.
double bounce_threshold(const LawSettings& settings);

}  // namespace turbidite::nscd
