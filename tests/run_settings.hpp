// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The keys that every run has (run_values.hpp), for tests that make their settings by hand: a wet
// run of 6 windows in a closed box of 10 D x 10 D with D = u_c = t_c = g = rho_f = 1.
#pragma once

#include <string>

#include "coupler/protocol/settings.hpp"

namespace turbidite {

inline void set_run_keys(Settings& s) {
    s.set("dimension", std::int64_t{2});
    s.set("fluid.enabled", true);
    s.set("fluid.hydrodynamic_radius", 1.0);
    for (const char* side : {"left", "right", "bottom", "top"})
        s.set(std::string("domain.") + side, std::string("wall"));
    for (const char* unit :
         {"diameter", "velocity_scale", "time_scale", "gravity", "grain_weight", "fluid_density"})
        s.set(std::string("run.") + unit, 1.0);
    s.set("run.viscosity", 0.1);
    s.set("run.acceleration_x", 0.0), s.set("run.acceleration_y", 0.0);
    s.set("run.step", 0.01);
    s.set("run.windows", std::int64_t{6});
    s.set("run.output_every", std::int64_t{2});
    s.set("run.size_x", 10.0), s.set("run.size_y", 10.0), s.set("run.size_z", 0.0);
}

inline Settings run_settings() {
    Settings settings;
    set_run_keys(settings);
    return settings;
}

}  // namespace turbidite
