// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/adapter_test/trial_grain.hpp"

#include <cmath>
#include <numbers>

#include "coupler/keys/key_spec.hpp"
#include "coupler/protocol/run_values.hpp"

namespace turbidite {

double volume_of(double radius, const Settings& settings) {
    const double disc = std::numbers::pi * radius * radius;
    return in_space(settings) ? 4.0 / 3.0 * radius * disc : disc;
}

double inertia_over_mass(const Settings& settings) {
    return in_space(settings) ? 0.4 : 0.5;
}

ImmersedRatios immersed_ratios(const Settings& settings) {
    const double ratio = settings.real("grains.density_ratio");
    if (!settings.flag("fluid.enabled")) return {ratio, ratio};
    const RunValues run = run_values(settings);
    const double radius = 0.5 * settings.real("run.diameter");
    const double hydrodynamic = run.hydrodynamic_radius * radius + run.surface_shift;
    const double displaced = volume_of(hydrodynamic, settings) / volume_of(radius, settings);
    return {ratio - displaced, ratio - 1.0};
}

}  // namespace turbidite
