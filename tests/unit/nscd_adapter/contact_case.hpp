// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Settings and grains shared by the tests of granular adapters. Keys not set here have the
// adapters' own defaults or belong to one test.
#pragma once

#include <cstdint>
#include <string>

#include "coupler/protocol/records.hpp"
#include "coupler/protocol/settings.hpp"
#include "tests/run_settings.hpp"

namespace turbidite {

/// Keys required by every contact case.
inline void set_contact_keys(Settings& settings) {
    settings.set("contact.friction", 0.3);
    settings.set("contact.tolerance", 1e-10);
    settings.set("contact.iterations", std::int64_t{100000});
    settings.set("contact.recovery_fraction", 0.2);
    settings.set("contact.recovery_speed", 0.5);
}

/// Box of 10 x 20 with walls on all sides, g = 1, rho_f = 1, u_c = 1; scheme split.
inline Settings box_settings() {
    Settings settings = run_settings();
    settings.set("coupling.positions", std::string("corrected"));
    set_contact_keys(settings);
    settings.set("run.size_y", 20.0);
    return settings;
}

/// rho_s = 1.5, D = 1.
inline GrainState grain_at(GrainId id, double x, double y) {
    GrainState grain;
    grain.id = id;
    grain.radius = 0.5;
    grain.density = 1.5;
    grain.position = {x, y, 0.0};
    return grain;
}

}  // namespace turbidite
