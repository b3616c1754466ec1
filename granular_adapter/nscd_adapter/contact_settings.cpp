// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd_adapter/contact_settings.hpp"

#include <algorithm>
#include <sstream>

namespace turbidite {
namespace {

void take(const Settings& settings, const char* key, double unit, double& value) {
    if (settings.has(key)) value = unit * settings.real(key);
}

void take(const Settings& settings, const char* key, std::string& name) {
    if (settings.has(key)) name = settings.text(key);
}

/// A coefficient of a surface: its key below contact, contact.materials.NAME and contact.pairs.A-B.
struct Coefficient {
    const char* key;
    double nscd::Surface::*value;
};
constexpr Coefficient coefficients[] = {
    {"friction", &nscd::Surface::friction},
    {"static_friction", &nscd::Surface::static_friction},
    {"restitution", &nscd::Surface::restitution},
    {"restitution_tangential", &nscd::Surface::restitution_tangential},
    {"rolling_friction", &nscd::Surface::rolling_friction},
    {"torsion_friction", &nscd::Surface::torsion_friction},
    {"adhesion_force", &nscd::Surface::adhesion},
};

/// Replaces the coefficients that the group specifies; the others stay.
nscd::Surface with_group(nscd::Surface surface, const Settings& settings,
                         const std::string& group) {
    for (const Coefficient& coefficient : coefficients) {
        const std::string key = group + "." + coefficient.key;
        if (!settings.has(key)) continue;
        const bool force = coefficient.value == &nscd::Surface::adhesion;
        const double unit = force ? settings.real("run.grain_weight") : 1.0;
        surface.*coefficient.value = unit * settings.real(key);
    }
    return surface;
}

/// "default" and the names of run.materials, in the order of the surfaces.
std::vector<std::string> material_names(const Settings& settings) {
    std::vector<std::string> names{"default"};
    if (!settings.has("run.materials")) return names;
    std::istringstream list(settings.text("run.materials"));
    for (std::string name; list >> name;) names.push_back(name);
    return names;
}

/// Surfaces of contact.materials.NAME and values of contact.pairs.A-B, which override the pair rule
/// of surface.hpp.
void take_materials(const Settings& settings, nscd::EngineSettings& result) {
    const std::vector<std::string> names = material_names(settings);
    for (std::size_t i = 1; i < names.size(); ++i)
        result.surfaces.push_back(
            with_group(result.surfaces[0], settings, "contact.materials." + names[i]));
    // Pairs by the rule of the smaller value; what contact.pairs.A-B names replaces single
    // coefficients.
    const nscd::SurfaceTable rule(result.surfaces);
    for (std::int32_t a = 0; a < rule.size(); ++a)
        for (std::int32_t b = 0; b < rule.size(); ++b) {
            const std::string group = "contact.pairs." + names[static_cast<std::size_t>(a)] + "-" +
                                      names[static_cast<std::size_t>(b)] + ".";
            const auto& entries = settings.entries();
            const bool given = std::any_of(entries.begin(), entries.end(), [&](const auto& entry) {
                return entry.first.rfind(group, 0) == 0;
            });
            if (given)
                result.surface_pairs.push_back(
                    {a, b,
                     with_group(rule.pair(a, b), settings, group.substr(0, group.size() - 1))});
        }
}

nscd::Surface surface(const Settings& settings) {
    nscd::Surface result;
    result.friction = settings.real("contact.friction");
    take(settings, "contact.static_friction", 1.0, result.static_friction);
    take(settings, "contact.restitution", 1.0, result.restitution);
    take(settings, "contact.restitution_tangential", 1.0, result.restitution_tangential);
    take(settings, "contact.rolling_friction", 1.0, result.rolling_friction);
    take(settings, "contact.torsion_friction", 1.0, result.torsion_friction);
    return result;
}

void take_adhesion(const Settings& settings, nscd::EngineSettings& result) {
    take(settings, "contact.adhesion", result.law.adhesion);
    if (result.law.adhesion == "none") return;
    const double diameter = settings.real("run.diameter");
    nscd::LawSettings& laws = result.law_settings;
    laws.reference_diameter = diameter;
    // In the case lengths are in D, forces in grain weights and speeds in u_c.
    laws.adhesion_range = diameter * settings.real("contact.adhesion_range");
    take(settings, "contact.adhesion_length", diameter, laws.adhesion_length);
    take(settings, "contact.adhesion_shear", 1.0, laws.adhesion_shear);
    result.surfaces[0].adhesion =
        settings.real("run.grain_weight") * settings.real("contact.adhesion_force");
}

/// Films of liquid, with a fluid; run.viscosity is nu.
void take_film(const Settings& settings, nscd::EngineSettings& result) {
    if (!settings.has("run.film_cutoff")) return;
    take(settings, "contact.film", result.law.film);
    nscd::LawSettings& laws = result.law_settings;
    // eta = rho_f nu
    laws.viscosity = settings.real("run.fluid_density") * settings.real("run.viscosity");
    laws.film_cutoff = settings.real("run.film_cutoff");
    laws.film_roughness = settings.real("run.diameter") * settings.real("contact.film_roughness");
}

}  // namespace

nscd::EngineSettings contact_settings(const Settings& settings) {
    nscd::EngineSettings result;
    const double velocity = settings.real("run.velocity_scale");
    result.surfaces = {surface(settings)};
    take(settings, "contact.law", result.law.friction);
    take(settings, "contact.impact", result.law.impact);
    take_adhesion(settings, result);
    take_film(settings, result);
    take_materials(settings, result);
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
