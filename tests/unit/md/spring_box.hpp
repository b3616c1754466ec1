// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The box and the springs in which hosts of molecular dynamics are tested without an adapter.
#pragma once

#include "coupler/shapes/shape.hpp"
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

/// The same 12 deep, with walls in front and at the back.
inline Settings soft_settings_in_space(double damping, double gravity) {
    Settings settings = soft_settings();
    settings.set("run.md_damping", damping), settings.set("run.gravity", gravity);
    settings.set("run.dimension", std::int64_t{3});
    settings.set("run.size_z", 12.0), settings.set("run.acceleration_z", 0.0);
    for (const char* side : {"domain.front", "domain.back"})
        settings.set(side, std::string("wall"));
    return settings;
}

/// The same with two opposite sides joined.
inline Settings cyclic(Settings settings, const char* one, const char* other) {
    for (const char* side : {one, other}) settings.set(side, std::string("cyclic"));
    return settings;
}

/// Of radius 0.5 and density 1.5.
inline nscd::Body soft_sphere(GrainId id, const Vec3& place, const Vec3& velocity) {
    const auto shape = make_shape({"sphere", {}});
    nscd::Body body;
    body.id = id;
    body.radius = 0.5;
    body.density = 1.5;
    body.mass = body.weight_mass = body.density * shape->volume(body.radius);
    body.inertia = body.density * shape->inertia_per_density(body.radius)(2, 2);
    body.position = place;
    body.twist.velocity = velocity;
    return body;
}

}  // namespace turbidite
