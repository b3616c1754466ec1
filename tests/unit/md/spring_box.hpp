// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The box and the springs in which hosts of molecular dynamics are tested without an adapter.
#pragma once

#include "tests/unit/nscd_adapter/contact_case.hpp"

namespace turbidite {

constexpr double frequency = 300.0;  ///< w [1/s]

/// Box of 20 x 10 with walls and an open top, without gravity; undamped, friction 0.3.
inline Settings soft_settings() {
    Settings settings = box_settings();
    settings.set("domain.top", std::string("free"));
    settings.set("run.size_x", 20.0), settings.set("run.size_y", 10.0);
    settings.set("run.gravity", 0.0);
    settings.set("run.md_frequency", frequency), settings.set("run.md_damping", 0.0);
    settings.set("run.md_substeps", std::int64_t{60});
    settings.set("contact.md_substeps", 20.0);
    settings.set("coupling.md_hold", true);
    return settings;
}

}  // namespace turbidite
