// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/forecast/courant_forecast.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "coupler/keys/key_spec.hpp"
#include "coupler/output/measures/courant_limit.hpp"
#include "coupler/rigid/vec3.hpp"
#include "launcher/case/forecast/prescribed_speed.hpp"
#include "launcher/case/grains/packing/pouring.hpp"

namespace turbidite {
namespace {

/// A sphere: weight = drag: (rho_r - 1) g pi D^3/6 = 1/2 C_D U^2 pi D^2/4 with C_D = 1/2, or
/// Stokes' 3 pi nu D U where viscosity rules.
double speed_of_a_sphere(const Scales& scales, double ratio, double diameter) {
    const double reduced = std::abs(ratio - 1.0) * scales.gravity * diameter;
    return std::min(std::sqrt(8.0 / 3.0 * reduced), reduced * diameter / (18.0 * scales.viscosity));
}

/// A disc: (rho_r - 1) g pi D^2/4 = 1/2 C_D U^2 D with C_D = 1, or about 2 pi nu U per length where
/// viscosity rules.
double speed_of_a_disc(const Scales& scales, double ratio, double diameter) {
    const double weight =
        std::abs(ratio - 1.0) * scales.gravity * std::numbers::pi / 4.0 * diameter;
    // `weight` is over D: U^2 = 2 weight, and U = weight D/(2 pi nu).
    return std::min(std::sqrt(2.0 * weight),
                    weight * diameter / (2.0 * std::numbers::pi * scales.viscosity));
}

/// Of the grains whose motion is not prescribed, each alone.
double fastest_fall(const ResolvedCase& resolved) {
    const auto speed_of = in_space(resolved.settings) ? speed_of_a_sphere : speed_of_a_disc;
    const Scales& scales = resolved.scales;
    if (is_poured(resolved.settings))  // what stands in for them may be smaller
        return speed_of(scales, resolved.settings.real("grains.density_ratio"), scales.diameter);
    double fastest = 0.0;
    for (const GrainState& grain : resolved.population)
        if (!grain.prescribed)
            fastest = std::max(fastest, speed_of(scales, grain.density / scales.fluid_density,
                                                 2.0 * grain.radius));
    return fastest;
}

double fastest_grain(const ResolvedCase& resolved) {
    double fastest = 0.0;
    for (const GrainState& grain : resolved.population)
        fastest = std::max(fastest, norm(grain.velocity));
    return fastest;
}

}  // namespace

double forecast_courant(const ResolvedCase& resolved) {
    const Settings& settings = resolved.settings;
    if (!settings.flag("fluid.enabled")) return 0.0;
    const double speed =
        std::max({fastest_fall(resolved), fastest_grain(resolved), fastest_prescribed(resolved)});
    const double cell = resolved.scales.diameter / settings.real("fluid.cells_per_diameter");
    // |u| dt/h of what moves fastest; the flow around it may be faster.
    return speed * settings.real("run.step") / cell;
}

std::string courant_warning(const ResolvedCase& resolved) {
    const double courant = forecast_courant(resolved);
    if (!(courant > largest_courant)) return "";
    return fmt::format("the Courant number will be {:.2g} or more. {}", courant,
                       courant_advice(resolved.settings.real("time.step"), courant));
}

}  // namespace turbidite
