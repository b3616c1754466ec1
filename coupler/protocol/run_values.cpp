// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/protocol/run_values.hpp"

namespace turbidite {
namespace {

double period(const Settings& settings, const char* side, double size) {
    return settings.text(side) == "cyclic" ? size : 0.0;
}

void read_fluid(const Settings& settings, RunValues& run) {
    run.fluid_density = settings.real("run.fluid_density");
    run.viscosity = settings.real("run.viscosity");
    run.hydrodynamic_radius = settings.real("fluid.hydrodynamic_radius");
    run.acceleration = {settings.real("run.acceleration_x"), settings.real("run.acceleration_y")};
}

}  // namespace

RunValues run_values(const Settings& settings) {
    RunValues run;
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
    run.fields_every = settings.has("run.fields_every") ? settings.integer("run.fields_every")
                                                        : run.output_every;
    run.size = {settings.real("run.size_x"), settings.real("run.size_y")};
    run.period = {period(settings, "domain.left", run.size[0]),
                  period(settings, "domain.bottom", run.size[1]), 0.0};
    return run;
}

}  // namespace turbidite
