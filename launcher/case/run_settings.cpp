// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/run_settings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "coupler/hub/schemes/scheme.hpp"
#include "coupler/keys/key_spec.hpp"
#include "coupler/rigid/rotation.hpp"
#include "launcher/case/fluid_cut.hpp"
#include "launcher/case/grains/grain_abilities.hpp"
#include "launcher/case/grains/grains_adapters.hpp"
#include "launcher/case/grains/materials.hpp"
#include "launcher/case/grains/soft_contact.hpp"
#include "launcher/case/walls/space_walls.hpp"
#include "launcher/case/walls/wall_motion.hpp"

namespace turbidite {
namespace {

void set_materials(Settings& settings) {
    std::string names;
    for (const std::string& name : material_names(settings))
        if (name != "default") names += (names.empty() ? "" : " ") + name;
    settings.set("run.materials", names);
}

std::string text_of(const std::vector<InnerWall>& walls, const Settings& settings,
                    const Scales& scales) {
    const double friction = settings.real("contact.friction");
    return in_space(settings)
               ? space_walls_setting(walls, scales, friction, material_names(settings))
               : walls_setting(walls, scales, friction);
}

/// The material of the sides of the box, if it is not the first.
void set_side_material(Settings& settings) {
    if (!settings.has("domain.material")) return;
    const auto names = material_names(settings);
    const auto at = std::find(names.begin(), names.end(), settings.text("domain.material"));
    settings.set("run.side_material", std::int64_t{at - names.begin()});
}

/// The coupling scheme, resolved here once for all programs.
void set_scheme(Settings& settings) {
    const SchemeEntry& scheme = find_scheme(scheme_name(settings));
    settings.set("run.scheme", std::string(scheme.name));
    settings.set("run.repeats_windows", scheme.repeats);
    settings.set("run.slip_tolerance", scheme.slip_tolerance(settings));
}

double height_of(const Packing& grains) {
    double height = 0.0;
    for (const PlacedGrain& grain : grains) height = std::max(height, grain.y + grain.radius);
    return height;
}

/// 1/(1 + cM R^2/cI) of the grain for which it is smallest, at most that of dry grains, 1/3 of
/// discs and 2/7 of spheres: an impulse moves the point of contact 1 + M R^2/I times as far along
/// it as across. A sphere with a shift has less cI than cM; with the share of dry spheres its
/// tangential springs would need more sub-steps than its normal ones
/// (docs/decisions/molecular-dynamics.md).
double tangential_share(const Settings& settings, const Packing& grains) {
    if (!in_space(settings)) return 1.0 / 3.0;
    double share = 2.0 / 7.0;
    if (!settings.flag("fluid.enabled")) return share;
    // Missing where every grain has its own.
    const double common =
        settings.has("grains.density_ratio") ? settings.real("grains.density_ratio") : 1.0;
    for (const PlacedGrain& grain : grains) {
        if (grain.prescribed) continue;
        const double seen = seen_radius(settings, grain.radius);
        const double ratio = grain.density.value_or(common);
        // Over M and I: c = 1 - R_h^3/rho_r and 1 - R_h^5/rho_r, with I = 2/5 M R^2.
        const double mass = 1.0 - std::pow(seen, 3) / ratio,
                     inertia = 1.0 - std::pow(seen, 5) / ratio;
        if (inertia > 0.0) share = std::min(share, 1.0 / (1.0 + 2.5 * mass / inertia));
    }
    return share;
}

/// The contact parameters and sub-steps of molecular dynamics.
void set_soft_contact(Settings& settings, const Packing& grains) {
    if (grains_adapter(settings).contacts == Contacts::rigid) return;
    const SoftContact contact = soft_contact(settings, height_of(grains));
    settings.set("run.md_frequency", contact.frequency);
    settings.set("run.md_damping", contact.damping);
    settings.set("run.md_substeps", contact.substeps);
    settings.set("run.md_tangential_share", tangential_share(settings, grains));
}

/// How many layers of cells each rank of the fluid has.
void set_fluid_layers(Settings& settings, const Packing& grains) {
    const std::vector<int> layers = cut_by_work(settings, grains);
    if (!layers.empty())
        settings.set("run.fluid_layers", fmt::format("{}", fmt::join(layers, " ")));
}

}  // namespace

void choose_scheme(Settings& settings) {
    if (!settings.has("coupling.scheme") || settings.text("coupling.scheme") != "auto") return;
    const bool known = settings.has("grains.adapter") && settings.has("fluid.enabled") &&
                       settings.flag("fluid.enabled");
    const SchemeEntry& scheme =
        known ? best_scheme(grains_adapter(settings)) : scheme_without_rounds();
    settings.set("coupling.scheme", std::string(scheme.name));
}

void set_run_settings(Settings& settings, const Packing& grains,
                      const std::vector<InnerWall>& walls, const Scales& scales) {
    set_run_values(settings, scales);
    set_scheme(settings);
    settings.set("run.walls", text_of(walls, settings, scales));
    settings.set("run.wall_motions", motions_setting(settings, walls, scales));
    settings.set("run.inflow_motions", inflows_setting(settings, scales));
    settings.set("run.grain_motions", grain_motions_setting(settings, grains, scales));
    set_materials(settings);
    set_side_material(settings);
    set_soft_contact(settings, grains);
    set_fluid_layers(settings, grains);
}

std::vector<GrainState> grain_states(const Packing& grains, const Settings& settings,
                                     const Scales& scales) {
    const bool space = in_space(settings);
    std::vector<GrainState> states;
    for (const PlacedGrain& grain : grains) {
        GrainState state;
        state.id = grain.id;
        state.shape = grain.shape;
        state.orientation = space ? grain.turn : about_z(grain.angle);
        state.radius = grain.radius * scales.diameter;
        state.material = grain.material;
        state.prescribed = grain.prescribed;
        state.density =
            grain.density.value_or(settings.real("grains.density_ratio")) * scales.fluid_density;
        state.velocity = {grain.vx * scales.velocity, grain.vy * scales.velocity,
                          grain.vz * scales.velocity};
        state.angular_velocity = {grain.wx / scales.time, grain.wy / scales.time,
                                  grain.spin / scales.time};
        state.position = {grain.x * scales.diameter, grain.y * scales.diameter,
                          grain.z * scales.diameter};
        states.push_back(state);
    }
    return states;
}

}  // namespace turbidite
