// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/scales.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "coupler/keys/key_spec.hpp"
#include "coupler/keys/key_value.hpp"
#include "granular_adapter/contact_keys/contact_keys.hpp"
#include "launcher/case/slices.hpp"

namespace turbidite {
namespace {

constexpr double most_turns = 1e15;  // windows: no run has as many

double reynolds_velocity_viscosity(const Settings& settings, Scales& scales) {
    if (!settings.has("fluid.reynolds")) return 0.0;
    scales.reynolds = settings.real("fluid.reynolds");
    // nu = u_c D/Re_c
    return scales.velocity * scales.diameter / scales.reynolds;
}

Scales avalanche(const Settings& settings) {
    Scales scales{.kind = "avalanche"};
    scales.viscosity = reynolds_velocity_viscosity(settings, scales);
    return scales;
}

Scales sedimentation(const Settings& settings) {
    Scales scales{.kind = "sedimentation"};
    const double unit_gravity = sedimentation_velocity(
        1.0, 1.0, settings.real("grains.density_ratio"), settings.real("scales.compacity"));
    scales.gravity = 1.0 / (unit_gravity * unit_gravity);  // Eq. 21: u_c ~ sqrt(g), and u_c = 1
    scales.viscosity = reynolds_velocity_viscosity(settings, scales);
    return scales;
}

Scales physical(const Settings& settings) {
    Scales scales{.kind = "physical"};
    scales.diameter = settings.real("scales.diameter");
    scales.gravity = settings.real("scales.gravity");
    scales.fluid_density = settings.real("scales.fluid_density");
    scales.viscosity = settings.real("scales.viscosity");
    scales.velocity = settings.has("scales.velocity")
                          ? settings.real("scales.velocity")
                          : sedimentation_velocity(scales.diameter, scales.gravity,
                                                   settings.real("grains.density_ratio"),
                                                   settings.real("scales.compacity"));
    // t_c = D/u_c
    scales.time = scales.diameter / scales.velocity;
    scales.reynolds = scales.velocity * scales.diameter / scales.viscosity;
    return scales;
}

void set_run_times(Settings& settings, double time_scale) {
    const double step = settings.real("time.step");
    const auto windows = std::llround(settings.real("time.end") / step);
    // The last window is written whether its turn has come or not; an interval beyond the end stays
    // what it is, so that a run that goes on to a later end has the rows of one in one part.
    const auto turns = [](double ratio) {
        return std::llround(std::clamp(ratio, 1.0, most_turns));
    };
    const auto every = turns(settings.real("output.interval") / step);
    settings.set("run.step", step * time_scale);
    settings.set("run.windows", std::int64_t{windows});
    settings.set("run.output_every", std::int64_t{every});
    if (!settings.has("output.fields_interval")) return;
    const double fields = std::min(settings.real("output.fields_interval") / step, most_turns);
    const auto outputs = turns(fields / static_cast<double>(every));
    settings.set("run.fields_every", std::int64_t{every * outputs});
}

/// output.probes in run units: x and y, in space also z, of each point, one after the other.
void set_probes(Settings& settings, double diameter) {
    if (!settings.has("output.probes") || !settings.flag("fluid.enabled")) return;
    std::string points;
    for (const double x : real_list("output.probes", settings.text("output.probes")))
        points += (points.empty() ? "" : " ") + real_text(x * diameter);
    settings.set("run.probes", points);
}

/// output.slices in run units: axis and place of each plane, one after the other.
void set_slices(Settings& settings, double diameter) {
    std::string planes;
    for (const SlicePlane& plane : slices_of(settings))
        planes += (planes.empty() ? "" : " ") +
                  fmt::format("{} {}", plane.axis, real_text(plane.place * diameter));
    if (!planes.empty()) settings.set("run.slices", planes);
}

}  // namespace

double sedimentation_velocity(double diameter, double gravity, double density_ratio,
                              double compacity) {
    // Topin 2011, Eq. 21, with a root over its first factors: as printed it has the unit of a
    // squared velocity. |rho_r - 1|, so that light grains have a scale too.
    const double fall = std::numbers::pi * diameter / 2.0 * std::abs(density_ratio - 1.0) * gravity;
    return std::sqrt(fall) * std::pow(1.0 - compacity, 5);
}

Scales make_scales(const Settings& settings) {
    const std::string& kind = settings.text("scales.kind");
    if (kind == "avalanche") return avalanche(settings);
    if (kind == "sedimentation") return sedimentation(settings);
    return physical(settings);
}

void set_run_values(Settings& settings, const Scales& scales) {
    const bool wet = settings.flag("fluid.enabled"), space = in_space(settings);
    const std::vector<double> size = real_list("domain.size", settings.text("domain.size"));
    settings.set("run.diameter", scales.diameter);
    settings.set("run.velocity_scale", scales.velocity);
    settings.set("run.time_scale", scales.time);
    settings.set("run.gravity", scales.gravity);
    // m g in air of a disc of diameter D, per unit length, or of a sphere: the unit of forces in
    // contact laws.
    const double disc = std::numbers::pi / 4.0 * scales.diameter * scales.diameter;
    // (pi/4) D^2, in space (pi/6) D^3
    const double size_of_grain = space ? disc * scales.diameter / 1.5 : disc;
    settings.set("run.grain_weight", size_of_grain * settings.real("grains.density_ratio") *
                                         scales.fluid_density * scales.gravity);
    settings.set("run.fluid_density", wet ? scales.fluid_density : 0.0);
    settings.set("run.viscosity", wet ? scales.viscosity : 0.0);
    const std::vector<double> acceleration =
        real_list("fluid.acceleration", settings.text("fluid.acceleration"));
    // From [u_c/t_c].
    settings.set("run.acceleration_x", acceleration.at(0) * scales.velocity / scales.time);
    settings.set("run.acceleration_y", acceleration.at(1) * scales.velocity / scales.time);
    settings.set("run.size_x", size.at(0) * scales.diameter);
    settings.set("run.size_y", size.at(1) * scales.diameter);
    settings.set("run.size_z", (space ? size.at(2) : 1.0) * scales.diameter);
    // From cells.
    const auto in_cells = [&](const char* key) {
        return settings.real(key) * scales.diameter / settings.real("fluid.cells_per_diameter");
    };
    if (space) {
        settings.set("run.dimension", std::int64_t{3});
        settings.set("run.acceleration_z", acceleration.at(2) * scales.velocity / scales.time);
        if (wet) settings.set("run.surface_shift", in_cells("fluid.surface_shift"));
    }
    if (has_films(settings)) settings.set("run.film_cutoff", in_cells("contact.film_cutoff"));
    set_probes(settings, scales.diameter);
    set_slices(settings, scales.diameter);
    set_run_times(settings, scales.time);
}

}  // namespace turbidite
