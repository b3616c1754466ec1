// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/shapes/immersed_body.hpp"

namespace turbidite {

ImmersedBody immersed_body(const Shape& shape, double radius, double density, double fluid_density,
                           double hydrodynamic_radius) {
    // R_h: the multipliers fill V(R_h), the true volume V(R) carries mass and buoyancy.
    const double wet_radius = hydrodynamic_radius * radius;
    ImmersedBody body;
    body.mass = density * shape.volume(radius);
    body.inertia = density * shape.inertia_per_density(radius);
    body.displaced_mass = fluid_density * shape.volume(wet_radius);
    body.displaced_inertia = fluid_density * shape.inertia_per_density(wet_radius);
    // M - rho_f V(R_h) and I - I_f(R_h); with R_h = R these are c M and c I of Topin 2011, Eq. 9.
    body.effective_mass = body.mass - body.displaced_mass;
    body.effective_inertia = body.inertia - body.displaced_inertia;
    body.fluid_mass = fluid_density * shape.volume(radius);
    // (M - m_f) g is the weight, m_f = rho_f V(R).
    body.submerged_mass = body.mass - body.fluid_mass;
    return body;
}

}  // namespace turbidite
