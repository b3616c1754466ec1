// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/protocol/run_values.hpp"

#include "coupler/protocol/scene/sides.hpp"

namespace turbidite {
namespace {

void read_fluid(const Settings& settings, RunValues& run) {
    run.fluid_density = settings.real("run.fluid_density");
    run.viscosity = settings.real("run.viscosity");
    run.hydrodynamic_radius = settings.real("fluid.hydrodynamic_radius");
    const bool space = run.dimension == 3;
    if (settings.has("run.surface_shift")) run.surface_shift = settings.real("run.surface_shift");
    run.acceleration = {settings.real("run.acceleration_x"), settings.real("run.acceleration_y"),
                        space ? settings.real("run.acceleration_z") : 0.0};
}

}  // namespace

RunValues run_values(const Settings& settings) {
    RunValues run;
    run.dimension = dimension_of(settings);
    run.diameter = settings.real("run.diameter");
    run.velocity = settings.real("run.velocity_scale");
    run.time = settings.real("run.time_scale");
    run.gravity = settings.real("run.gravity");
    run.grain_weight = settings.real("run.grain_weight");
    run.wet = settings.flag("fluid.enabled");
    if (run.wet) read_fluid(settings, run);
    run.step = settings.real("run.step");
    run.windows = settings.integer("run.windows");
    run.output_every = settings.integer("run.output_every");
    run.fields_every =
        settings.has("run.fields_every") ? settings.integer("run.fields_every") : run.output_every;
    run.size = {settings.real("run.size_x"), settings.real("run.size_y"),
                run.dimension == 3 ? settings.real("run.size_z") : 0.0};
    for (std::size_t side = 0; side < side_count(run.dimension); side += 2)
        if (const auto& [name, key, axis, inward] = box_sides[side]; settings.text(key) == "cyclic")
            // Opposite sides are both cyclic or neither (side_types): one of each pair tells.
            run.period[axis] = run.size[axis];
    return run;
}

}  // namespace turbidite
