// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/shapes/immersed_body.hpp"

namespace turbidite {

ImmersedBody immersed_body(const Shape& shape, double radius, double density, double fluid_density,
                           double hydrodynamic_radius) {
    const double wet_radius = hydrodynamic_radius * radius;
    ImmersedBody body;
    body.mass = density * shape.volume(radius);
    body.inertia = density * shape.inertia_per_density(radius);
    body.displaced_mass = fluid_density * shape.volume(wet_radius);
    body.displaced_inertia = fluid_density * shape.inertia_per_density(wet_radius);
    body.effective_mass = body.mass - body.displaced_mass;
    body.effective_inertia = body.inertia - body.displaced_inertia;
    body.fluid_mass = fluid_density * shape.volume(radius);
    body.submerged_mass = body.mass - body.fluid_mass;
    return body;
}

}  // namespace turbidite
