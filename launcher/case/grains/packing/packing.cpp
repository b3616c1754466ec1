// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/grains/packing/packing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "launcher/case/grains/packing/lattice.hpp"
#include "launcher/case/grains/packing/pouring.hpp"
#include "launcher/case/grains/packing/random_packing.hpp"
#include "launcher/case/grains/packing/space_lattice.hpp"
#include "launcher/case/grains/packing/space_packing.hpp"

namespace turbidite {

double largest_radius(const Packing& grains) {
    double largest = grains.empty() ? 0.5 : 0.0;
    for (const PlacedGrain& grain : grains) largest = std::max(largest, grain.radius);
    return largest;
}

namespace {

bool is_within(const PackingCylinder& cylinder, const Vec3& place, double radius) {
    const Vec3 axis = cylinder.to - cylinder.from, arm = place - cylinder.from;
    const double length = norm(axis), height = dot(arm, axis) / length;
    return height >= radius - fit_rounding && height <= length - radius + fit_rounding &&
           // The sphere is inside both ends, and its centre no nearer to the shell than its radius.
           norm(arm - (height / length) * axis) <= cylinder.radius - radius + fit_rounding;
}

PackingResult not_poured_in_the_plane(const PackingRequest&) {
    PackingResult result;
    result.refusal =
        "Grains of the plane are not poured in this version. Let them fall in a dry run of their "
        "own and start from it with run --from.";
    return result;
}

}  // namespace

double PackingRegion::volume() const {
    if (!cylinder) return width * height * depth;
    return std::numbers::pi * cylinder->radius * cylinder->radius *
           norm(cylinder->to - cylinder->from);
}

bool PackingRegion::holds(const Vec3& place, double radius) const {
    if (cylinder) return is_within(*cylinder, place, radius);
    const Vec3 at = place - corner;
    return at[0] >= radius - fit_rounding && at[0] + radius <= width + fit_rounding &&
           at[1] >= radius - fit_rounding && at[1] + radius <= height + fit_rounding &&
           at[2] >= radius - fit_rounding && at[2] + radius <= depth + fit_rounding;
}

/// A circle normal to the unit vector e extends by R sqrt(1 - e_i^2) along axis i.
PackingRegion enclosing(const PackingCylinder& cylinder) {
    const Vec3 along = cylinder.to - cylinder.from, e = along / norm(along);
    Vec3 low{}, size{};
    for (std::size_t i = 0; i < 3; ++i) {
        const double half = cylinder.radius * std::sqrt(std::max(0.0, 1.0 - e[i] * e[i]));
        low[i] = std::min(cylinder.from[i], cylinder.to[i]) - half;
        size[i] = std::abs(along[i]) + 2.0 * half;
    }
    return {size[0], size[1], size[2], low, cylinder};
}

const std::vector<GeneratorEntry>& generator_list() {
    static const std::vector<GeneratorEntry> generators = {
        {"lattice", "touching rows of grains.compacity, filled from the lower left corner",
         lattice_packing, space_lattice_packing},
        {"random", "grains.count grains without overlap", random_packing, random_space_packing},
        {"poured", "grains.count spheres that fall and come to rest before the run (dimension: 3)",
         not_poured_in_the_plane, poured_stand_in},
    };
    return generators;
}

}  // namespace turbidite
