// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/run_cost.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "launcher/case/mesh_cost.hpp"

namespace turbidite {
namespace {

constexpr double contact_time = 10e-6;  // seconds per grain and window of contact dynamics
constexpr double spring_time = 1.3e-6;  // and per grain and sub-step of springs
constexpr double seconds_to_start = 2.0;

double dry_window_time(const Settings& settings, double grains) {
    const bool springs = settings.has("run.md_substeps");
    const double substeps =
        springs ? static_cast<double>(settings.integer("run.md_substeps")) : 0.0;
    return grains * (springs ? substeps * spring_time : contact_time);
}

}  // namespace

double predicted_seconds(const ResolvedCase& resolved) {
    const Settings& settings = resolved.settings;
    const double window =
        settings.flag("fluid.enabled")
            ? fluid_window_time(settings)
            : dry_window_time(settings, static_cast<double>(resolved.population.size()));
    return seconds_to_start + window * static_cast<double>(settings.integer("run.windows"));
}

std::string rough_time(double seconds) {
    if (seconds < 100.0) return fmt::format("{:.0f} s", std::max(1.0, seconds));
    if (seconds < 6000.0) return fmt::format("{:.0f} min", seconds / 60.0);
    if (seconds < 172800.0) return fmt::format("{:.0f} h", seconds / 3600.0);
    return fmt::format("{:.0f} days", seconds / 86400.0);
}

}  // namespace turbidite
