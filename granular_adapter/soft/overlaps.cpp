// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/soft/overlaps.hpp"

#include <algorithm>

#include "coupler/rigid/vec3.hpp"

namespace turbidite::soft {

void OverlapFinder::find(const nscd::Bodies& bodies) {
    overlaps_.clear();
    const nscd::PlacedShapes placed = narrow_.place(bodies, walls_);
    for (const Near& near : neighbours_.of(bodies, walls_)) detect(bodies, near, placed);
}

void OverlapFinder::detect(const nscd::Bodies& bodies, const Near& near,
                           const nscd::PlacedShapes& placed) {
    constexpr double alert = 0.0;  // overlaps only
    points_.clear();
    if (near.wall < 0)
        narrow_.pair(
            {bodies, near.a, near.b,
             box_.minimum_image(bodies.position[near.b] - bodies.position[near.a]), alert, &placed},
            points_);
    else
        narrow_.wall({bodies, near.b, walls_[near.wall], near.wall, alert, &placed}, points_);
    if (points_.empty()) return;
    std::sort(points_.begin(), points_.end(),
              [](const auto& x, const auto& y) { return x.feature < y.feature; });
    const double mass = mass_of_point(bodies, near);
    for (const nscd::ContactPoint& point : points_) {
        overlaps_.push_back({near.name, point, mass});
        overlaps_.back().name.feature = is_of_one_point(bodies, near) ? 0 : point.feature;
    }
}

bool OverlapFinder::has_corners(const nscd::Bodies& bodies, std::int32_t body) const {
    return narrow_.has_corners(bodies.shape[body]);
}

bool OverlapFinder::is_of_one_point(const nscd::Bodies& bodies, const Near& near) const {
    return near.wall < 0 && !(has_corners(bodies, near.a) && has_corners(bodies, near.b));
}

double OverlapFinder::mass_of_point(const nscd::Bodies& bodies, const Near& near) const {
    const double b = bodies.mass[near.b];
    // m_r = m_a m_b/(m_a + m_b), at a wall m_b
    const double reduced = near.wall < 0 ? bodies.mass[near.a] * b / (bodies.mass[near.a] + b) : b;
    const bool sides =
        has_corners(bodies, near.b) && (near.wall >= 0 || has_corners(bodies, near.a));
    // Two points of a side together have the spring of a contact of discs; a single one half of it.
    return sides ? 0.5 * reduced : reduced;
}

}  // namespace turbidite::soft
