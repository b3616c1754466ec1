// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/laws/surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace turbidite::nscd {
namespace {

void demand(double value, double most, const char* name, std::size_t material) {
    if (value >= 0.0 && value <= most) return;  // also refuses NaN
    throw std::invalid_argument(
        "material " + std::to_string(material) + ": " + name + " = " + std::to_string(value) +
        (std::isfinite(most) ? " must lie in [0, 1]" : " must be zero or positive"));
}

void check(const Surface& surface, std::size_t material) {
    constexpr double any = std::numeric_limits<double>::infinity();
    demand(surface.friction, any, "friction", material);
    demand(surface.static_friction, any, "static friction", material);
    demand(surface.restitution, 1.0, "restitution", material);
    demand(surface.restitution_tangential, 1.0, "tangential restitution", material);
    demand(surface.rolling_friction, any, "rolling friction", material);
    demand(surface.adhesion, any, "adhesion", material);
    demand(surface.torsion_friction, any, "torsion friction", material);
}

Surface smaller(const Surface& a, const Surface& b) {
    return {std::min(a.friction, b.friction),
            std::min(a.static_friction, b.static_friction),
            std::min(a.restitution, b.restitution),
            std::min(a.restitution_tangential, b.restitution_tangential),
            std::min(a.rolling_friction, b.rolling_friction),
            std::min(a.adhesion, b.adhesion),
            std::min(a.torsion_friction, b.torsion_friction)};
}

}  // namespace

SurfaceTable::SurfaceTable(std::vector<Surface> surfaces, std::vector<SurfacePair> pairs)
    : count_(static_cast<std::int32_t>(surfaces.size())) {
    if (surfaces.empty()) throw std::invalid_argument("contacts need at least one material");
    for (std::size_t i = 0; i < surfaces.size(); ++i) check(surfaces[i], i);
    for (const Surface& a : surfaces)
        for (const Surface& b : surfaces) pairs_.push_back(smaller(a, b));
    for (const SurfacePair& pair : pairs) {
        const std::int32_t low = std::min(pair.first, pair.second);
        const std::int32_t high = std::max(pair.first, pair.second);
        if (low < 0 || high >= count_)
            throw std::invalid_argument("materials " + std::to_string(low) + " and " +
                                        std::to_string(high) + ": there are only " +
                                        std::to_string(count_));
        check(pair.values, static_cast<std::size_t>(low));
        // Both entries, so that the table is symmetric.
        pairs_[static_cast<std::size_t>(low * count_ + high)] = pair.values;
        pairs_[static_cast<std::size_t>(high * count_ + low)] = pair.values;
    }
}

double SurfaceTable::largest_restitution() const {
    double largest = 0.0;
    for (const Surface& pair : pairs_)
        largest = std::max({largest, pair.restitution, pair.restitution_tangential});
    return largest;
}

}  // namespace turbidite::nscd
