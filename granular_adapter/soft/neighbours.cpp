// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/soft/neighbours.hpp"

#include <algorithm>
#include <utility>

#include "coupler/rigid/vec3.hpp"
#include "granular_adapter/nscd/detection/broad_phase.hpp"

namespace turbidite::soft {
namespace {

Near near_pair(const nscd::Bodies& bodies, std::int32_t a, std::int32_t b) {
    if (bodies.id[a] > bodies.id[b]) std::swap(a, b);
    return {{bodies.id[a], bodies.id[b], 0, 0}, a, b, -1};
}

Near near_wall(const nscd::Bodies& bodies, std::int32_t b, std::int32_t index,
               const nscd::Wall& wall) {
    return {{wall.key, bodies.id[b], 1, 0}, -1, b, index};
}

}  // namespace

const std::vector<Near>& Neighbours::of(const nscd::Bodies& bodies,
                                        const std::vector<nscd::Wall>& walls) {
    if (!complete(bodies.position)) search(bodies, walls);
    return near_;
}

bool Neighbours::complete(const std::vector<Vec3>& positions) const {
    if (places_.size() != positions.size()) return false;
    // (skin/2)^2: two grains that have both moved by half the skin are nearer by the skin at most.
    const double limit = 0.25 * skin_ * skin_;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const Vec3 moved = box_.minimum_image(positions[i] - places_[i]);
        if (!(dot(moved, moved) <= limit)) return false;
    }
    return true;
}

void Neighbours::search(const nscd::Bodies& bodies, const std::vector<nscd::Wall>& walls) {
    places_ = bodies.position;
    near_.clear();
    for (const nscd::Pair& pair :
         nscd::candidate_pairs(bodies.position, bodies.radius, skin_, box_))
        near_.push_back(near_pair(bodies, pair.a, pair.b));
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(bodies.size()); ++i)
        for (std::int32_t w = 0; w < static_cast<std::int32_t>(walls.size()); ++w)
            if (signed_distance(walls[w], bodies.position[i]) < bodies.radius[i] + skin_)
                near_.push_back(near_wall(bodies, i, w, walls[w]));
    std::sort(near_.begin(), near_.end(),
              [](const Near& x, const Near& y) { return x.name < y.name; });
}

}  // namespace turbidite::soft
