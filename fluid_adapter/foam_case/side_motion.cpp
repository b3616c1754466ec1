// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/foam_case/side_motion.hpp"

#include <stdexcept>
#include <string>

#include "fluid_adapter/foam_case/fluid_domain.hpp"

namespace turbidite {
namespace {

bool parabolic(const Settings& settings, const char* side) {
    const std::string key = "domain." + std::string(side) + "_profile";
    if (!settings.has(key) || settings.text(key) == "uniform") return false;
    if (settings.text(key) == "parabolic") return true;
    throw std::invalid_argument(key + " = \"" + settings.text(key) +
                                "\"; allowed are uniform, parabolic");
}

/// 6 s (1 - s), integrated from 0.
double integrated_parabola(double s) {
    return s * s * (3.0 - 2.0 * s);
}

}  // namespace

std::array<double, 2> SideMotion::velocity(double time, double step) const {
    if (!motion) return {0.0, 0.0};
    const Vec3 rate = motion->rate(time, step).velocity;
    return {rate[0], rate[1]};
}

double SideMotion::share(double from, double to) const {
    if (!parabolic) return 1.0;
    return (integrated_parabola(to) - integrated_parabola(from)) / (to - from);
}

std::array<SideMotion, 4> side_motions(const Settings& settings) {
    std::array<SideMotion, 4> sides;
    for (const char* key : {"run.wall_motions", "run.inflow_motions"})
        for (const Moved& moved : motions_of(settings, key))
            if (moved.what < 4) sides[moved.what].motion = moved.motion;
    for (int side = 0; side < 4; ++side)
        sides[side].parabolic = parabolic(settings, side_names[side]);
    return sides;
}

}  // namespace turbidite
