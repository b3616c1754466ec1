// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Discs and spheres of trials, for expectations in closed form.
#pragma once

#include "coupler/protocol/settings.hpp"

namespace turbidite {

/// Volume of a sphere, in the plane area of a disc [m3, m2].
double volume_of(double radius, const Settings& settings);

/// I/(m r^2): 2/5, in the plane 1/2.
double inertia_over_mass(const Settings& settings);

/// cM = M - m_f(R_h) over M - m_f: inertia and weight of a grain of radius D/2 and the case's
/// density, over rho_f volume(D/2); dry, both are the density ratio.
struct ImmersedRatios {
    double inertia = 0.0, weight = 0.0;
};
ImmersedRatios immersed_ratios(const Settings& settings);

}  // namespace turbidite
