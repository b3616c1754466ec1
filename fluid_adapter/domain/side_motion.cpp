// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/domain/side_motion.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "coupler/protocol/scene/plates.hpp"

namespace turbidite {
namespace {

bool parabolic(const Settings& settings, const BoxSide& side) {
    const std::string key = std::string(side.key) + "_profile";
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

void MovedSides::add(std::size_t side, const Vec3& v) {
    any = true;
    through = std::max(through, std::abs(v[side / 2]));  // left, right: x, ...
}

Vec3 SideMotion::velocity(double time, double step) const {
    return motion ? motion->rate(time, step).velocity : Vec3{};
}

double SideMotion::share(double from, double to) const {
    if (!parabolic) return 1.0;
    return (integrated_parabola(to) - integrated_parabola(from)) / (to - from);
}

std::array<SideMotion, box_sides.size()> side_motions(const Settings& settings) {
    std::array<SideMotion, box_sides.size()> sides;
    const std::int32_t plates = first_plate(dimension_of(settings));
    for (const Moved& wall : motions_of(settings, "run.wall_motions"))
        if (wall.what < plates) sides[wall.what].motion = wall.motion;
    // Only fluid that enters has a profile.
    for (const Moved& inflow : motions_of(settings, "run.inflow_motions"))
        if (inflow.what < plates)
            sides[inflow.what] = {inflow.motion, parabolic(settings, box_sides[inflow.what])};
    return sides;
}

}  // namespace turbidite
