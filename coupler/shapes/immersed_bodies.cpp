// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/shapes/immersed_bodies.hpp"

namespace turbidite {

ImmersedBodies::ImmersedBodies(const Settings& settings, const ShapeTable& shapes)
    : fluid_density_(settings.flag("fluid.enabled") ? settings.real("run.fluid_density") : 0.0),
      hydrodynamic_radius_(settings.real("fluid.hydrodynamic_radius")) {
    for (const ShapeRecord& record : shapes) shapes_.push_back(make_shape(record));
}

ImmersedBody ImmersedBodies::operator()(const GrainState& grain) const {
    return immersed_body(*shapes_.at(grain.shape), grain.radius, grain.density, fluid_density_,
                         hydrodynamic_radius_);
}

}  // namespace turbidite
