// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd_adapter/contact_settings.hpp"

namespace turbidite {
namespace {

void take(const Settings& settings, const char* key, double unit, double& value) {
    if (settings.has(key)) value = unit * settings.real(key);
}

void take(const Settings& settings, const char* key, std::string& name) {
    if (settings.has(key)) name = settings.text(key);
}

nscd::Surface surface(const Settings& settings) {
    nscd::Surface result;
    result.friction = settings.real("contact.friction");
    take(settings, "contact.static_friction", 1.0, result.static_friction);
    take(settings, "contact.restitution", 1.0, result.restitution);
    take(settings, "contact.restitution_tangential", 1.0, result.restitution_tangential);
    take(settings, "contact.rolling_friction", 1.0, result.rolling_friction);
    return result;
}

void take_adhesion(const Settings& settings, nscd::EngineSettings& result) {
    take(settings, "contact.adhesion", result.law.adhesion);
    if (result.law.adhesion == "none") return;
    const double diameter = settings.real("run.diameter");
    nscd::LawSettings& laws = result.law_settings;
    laws.reference_diameter = diameter;
    laws.adhesion_range = diameter * settings.real("contact.adhesion_range");
    take(settings, "contact.adhesion_length", diameter, laws.adhesion_length);
    take(settings, "contact.adhesion_shear", 1.0, laws.adhesion_shear);
    result.surfaces[0].adhesion =
        settings.real("run.grain_weight") * settings.real("contact.adhesion_force");
}

}  // namespace

nscd::EngineSettings contact_settings(const Settings& settings) {
    nscd::EngineSettings result;
    const double velocity = settings.real("run.velocity_scale");
    result.theta = settings.real("contact.theta");
    result.surfaces = {surface(settings)};
    take(settings, "contact.law", result.law.friction);
    take(settings, "contact.impact", result.law.impact);
    take_adhesion(settings, result);
    take(settings, "contact.recovery_fraction", 1.0, result.law_settings.recovery_fraction);
    take(settings, "contact.recovery_speed", velocity, result.law_settings.recovery_speed);
    take(settings, "contact.restitution_speed", velocity, result.law_settings.restitution_speed);
    take(settings, "contact.solver", result.solver);
    result.solver_settings.tolerance = settings.real("contact.tolerance");
    result.solver_settings.max_iterations = settings.integer("contact.iterations");
    if (settings.has("contact.threads"))
        result.solver_settings.threads = settings.integer("contact.threads");
    return result;
}

}  // namespace turbidite
