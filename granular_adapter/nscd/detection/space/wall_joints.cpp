// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/detection/space/wall_joints.hpp"

#include <algorithm>
#include <cmath>

#include "coupler/rigid/vec3.hpp"

namespace turbidite::nscd {
namespace {

// Rims that are closer than this fraction of their radius or height coincide.
constexpr double same_rim = 1e-9;

// Cosine above which a meridian leads nearer to a centre: two points for one where it just does, so
// that rounding never leaves none.
constexpr double no_nearer = 1e-9;

/// Heights along the axis of `from` are base + sense * height of `wall`.
struct OnAxis {
    double base, sense;
};

bool same_axis(const Wall& from, const Wall& wall, double tolerance) {
    const Vec3 apart = wall.point - from.point;
    // Parallel axes, either way round, and no offset across them.
    return norm(cross(from.normal, wall.normal)) <= same_rim &&
           norm(apart - dot(apart, from.normal) * from.normal) <= tolerance;
}

/// The meridian of `wall` from its end on, if that is the rim `at` of `from`.
void join(Rim& rim, const BesideAxis& at, const Wall& wall, const OnAxis& on, double tolerance) {
    for (std::size_t end = 0; end < 2; ++end) {
        const BesideAxis &here = wall.meridian[end], &there = wall.meridian[1 - end];
        if (std::abs(here.radius - at.radius) > tolerance ||
            std::abs(on.base + on.sense * here.height - at.height) > tolerance)
            continue;
        rim.others.push_back({there.radius - here.radius, on.sense * (there.height - here.height)});
    }
}

}  // namespace

WallJoints::WallJoints(const std::vector<Wall>& walls) {
    const auto is_round = [](const Wall& wall) { return wall.form == WallForm::round; };
    if (std::count_if(walls.begin(), walls.end(), is_round) < 2) return;
    rims_.resize(walls.size());
    for (std::size_t i = 0; i < walls.size(); ++i)
        for (std::size_t j = 0; j < walls.size(); ++j)
            if (i != j && is_round(walls[i]) && is_round(walls[j])) join_pair(walls, i, j);
}

/// Tells wall i where it meets wall j.
void WallJoints::join_pair(const std::vector<Wall>& walls, std::size_t i, std::size_t j) {
    const Wall &own = walls[i], &other = walls[j];
    const double tolerance = same_rim * std::max(size_of(own), size_of(other));
    // Of two walls of different thickness the thicker one ends at the rim, with a round edge that
    // only its own point has.
    if (std::abs(own.half_thickness - other.half_thickness) > tolerance) return;
    if (!same_axis(own, other, tolerance)) return;
    const OnAxis on{dot(other.point - own.point, own.normal),
                    dot(own.normal, other.normal) > 0.0 ? 1.0 : -1.0};
    for (std::size_t end = 0; end < 2; ++end) {
        Rim& rim = rims_[i][end];
        const std::size_t before = rim.others.size();
        join(rim, own.meridian[end], other, on, tolerance);
        // Of the walls at a rim, the one with the lowest index keeps the point.
        if (j < i && rim.others.size() > before) rim.first = false;
    }
}

bool WallJoints::is_nearest(std::int32_t wall, std::size_t end, const BesideAxis& offset) const {
    if (rims_.empty()) return true;
    const Rim& rim = rims_[static_cast<std::size_t>(wall)][end];
    return rim.first && std::none_of(rim.others.begin(), rim.others.end(), [&](const auto& along) {
               return dot(offset, along) > no_nearer * norm(offset) * norm(along);
           });
}

}  // namespace turbidite::nscd
