// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The contact of molecular dynamics, a linear spring and dashpot without attraction, and its
// sub-steps. Two touching grains of reduced mass m_r have
//
//     k = m_r w^2,   c = 2 zeta m_r w        so all pairs bounce in the same time, pi/w undamped
//
// contact.md_stiffness is k over m g/D for two equal grains of mass m: w^2 = 2 stiffness g/D. It is
// the larger of the values that two situations need for an overlap of contact.md_overlap = d:
//
//     at rest   h/d         a packing of height h on its lowest contacts
//     impact    (f v)^2/(2 g D d^2)    two grains that approach at v = contact.md_speed; f is
//                           the deepest overlap of a bounce over v/w (1 undamped, 1/e critical)
//
// Unless given, v is 2 u_c in a fluid, and 2 sqrt(2 g h) without: more than the speed of a fall
// from the top, since whole rows of grains land together (docs/decisions/molecular-dynamics.md,
// "How stiff").
//
// The restitution of a bounce follows from zeta; without attraction it is (Schwager and Poeschel,
// Granular Matter 9 (2007) 465) 1 at zeta = 0 and exp(-2) = 0.135 at zeta = 1. More than critical
// damping would cost sub-steps, so this is the smallest restitution available: lower values,
// including 0, get zeta = 1.
#pragma once

#include <cstdint>

#include "coupler/protocol/settings.hpp"

namespace turbidite {

struct SoftContact {
    double stiffness = 0.0;     ///< [m g/D]
    double frequency = 0.0;     ///< w [1/s]
    double damping = 0.0;       ///< zeta, [0, 1]
    double contact_time = 0.0;  ///< pi/w [s]
    std::int64_t substeps = 1;  ///< per window
};

/// `height` [D] of the packing. Reads contact.md_*, contact.restitution and
/// run.{diameter,gravity,velocity_scale,step}.
SoftContact soft_contact(const Settings& settings, double height);

/// Restitution of a bounce, zeta in [0, 1].
double restitution_of(double damping);

/// zeta for a restitution in [0, 1]; 1 for all values below restitution_of(1).
double damping_of(double restitution);

/// Largest overlap of a bounce, divided by v/w; zeta in [0, 1].
double deepest_of(double damping);

}  // namespace turbidite
