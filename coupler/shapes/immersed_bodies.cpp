// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/shapes/immersed_bodies.hpp"

namespace turbidite {

ImmersedBodies::ImmersedBodies(const RunValues& run, const ShapeTable& shapes)
    : fluid_density_(run.fluid_density),
      hydrodynamic_radius_(run.hydrodynamic_radius),
      surface_shift_(run.surface_shift) {
    for (const ShapeRecord& record : shapes) shapes_.push_back(make_shape(record));
}

ImmersedBody ImmersedBodies::operator()(const GrainState& grain) const {
    // R_h = (R_h/R) R + s, s the surface shift [m]: divided by R, as immersed_body takes a ratio.
    return immersed_body(*shapes_.at(grain.shape), grain.radius, grain.density, fluid_density_,
                         hydrodynamic_radius_ + surface_shift_ / grain.radius);
}

}  // namespace turbidite
