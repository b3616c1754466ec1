// SPDX-License-Identifier: LGPL-2.1-or-later
//
// When a contact takes an impact in a step, and how restitution enters its bias.
//
// A body that would meet another within the step bounces at once, up to |u| dt before they touch:
// then nothing overlaps, and the velocities are those of the impact law whatever the gap was.
#pragma once

#include "granular_adapter/nscd/laws/law.hpp"

namespace turbidite::nscd {

/// Approaches faster than `threshold` and is closed, or closes within the step.
bool in_impact(const ContactSituation& situation, double threshold);

/// u_n >= -e u_n^-, and never less than the terms ask for already.
void demand_rebound(const ContactSituation& situation, double restitution, LawTerms& terms);

/// True where no pair of surfaces has a restitution.
bool never_bounces(const SurfaceTable& surfaces);

/// LawSettings::restitution_speed; throws std::invalid_argument unless it is >= 0.
double bounce_threshold(const LawSettings& settings);

}  // namespace turbidite::nscd
