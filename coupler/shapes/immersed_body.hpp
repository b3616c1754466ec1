// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The inertia with which an immersed grain enters steps 4 and 5 (Topin 2011, Eq. 9, c = 1 -
// rho_f/rho_s):
//
//     mass c M, inertia c I, weight c M g
//
// since the fluid that fills the fictitious domain already carries rho_f/rho_s of the grain's
// inertia. With a hydrodynamic radius R_h the multipliers fill V(R_h):
//
//     effective mass      M - rho_f V(R_h)         effective inertia   I - I_f(R_h)
//     submerged weight    (M - rho_f V(R)) g       (buoyancy acts on the true volume)
//
// Dry grains have rho_f = 0. Valid C++17.
#pragma once

#include "coupler/shapes/shape.hpp"

namespace turbidite {

struct ImmersedBody {
    double mass = 0.0;            ///< M [kg]
    Eigen::Matrix3d inertia;      ///< I, body frame [kg m2]
    double effective_mass = 0.0;  ///< M - rho_f V(R_h) [kg]
    Eigen::Matrix3d effective_inertia;
    double submerged_mass = 0.0;  ///< M - rho_f V(R): weight over g [kg]
    double fluid_mass = 0.0;      ///< rho_f V(R) [kg]
    double displaced_mass = 0.0;  ///< rho_f V(R_h): what F_h adds to the multipliers [kg]
    Eigen::Matrix3d displaced_inertia;
};

/// `hydrodynamic_radius` is R_h / R, positive. The effective mass and inertia of a grain that is
/// not denser than the fluid are zero or negative: it moves only together with the fluid it covers.
ImmersedBody immersed_body(const Shape& shape, double radius, double density, double fluid_density,
                           double hydrodynamic_radius);

}  // namespace turbidite
