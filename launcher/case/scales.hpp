// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The characteristic values of a case: D [m], u_c [m/s], t_c = D/u_c [s], g [m/s2], rho_f [kg/m3],
// nu [m2/s].
//
//     avalanche       D = u_c = rho_f = 1, g = 1 (u_c = sqrt(g D)),  nu = u_c D / Re
//     sedimentation   D = u_c = rho_f = 1, g from Eq. 21,            nu = u_c D / Re
//     physical        SI values of the case; u_c given, or from Eq. 21
//
// Topin 2011, Eq. 21, as printed has the unit of a squared velocity; it is read here as
//     u_c = sqrt((pi D / 2) (rho_r - 1) g) (1 - phi)^5,   phi the nominal compacity.
#pragma once

#include <string>

#include "coupler/protocol/settings.hpp"

namespace turbidite {

struct Scales {
    std::string kind;            ///< avalanche, sedimentation, physical
    double diameter = 1.0;       ///< D [m]
    double velocity = 1.0;       ///< u_c [m/s]
    double time = 1.0;           ///< t_c [s]
    double gravity = 1.0;        ///< g along -y [m/s2]
    double fluid_density = 1.0;  ///< rho_f, the unit of density even in dry cases [kg/m3]
    double viscosity = 0.0;      ///< nu [m2/s]; 0 in dry cases without one
    double reynolds = 0.0;       ///< u_c D / nu; 0 in dry cases without one
};

/// Eq. 21 with the diameter, gravity, density ratio and compacity given.
double sedimentation_velocity(double diameter, double gravity, double density_ratio,
                              double compacity);

/// From the validated keys `scales.*`, `grains.density_ratio`, `fluid.reynolds`.
Scales make_scales(const Settings& settings);

/// Sets run.diameter … run.output_every (see protocol/settings.hpp). In dry cases
/// run.fluid_density and run.viscosity are 0: there is no fluid.
void set_run_values(Settings& settings, const Scales& scales);

}  // namespace turbidite
