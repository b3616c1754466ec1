// SPDX-License-Identifier: GPL-3.0-or-later
#include "granular_adapter/yade/overlap.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "coupler/rigid/rotation.hpp"
#include "coupler/shapes/shape.hpp"
#include "coupler/shapes/surface_gap.hpp"
#include "granular_adapter/nscd/detection/broad_phase.hpp"
#include "granular_adapter/nscd/detection/detection.hpp"

namespace turbidite::yade {
namespace {

bool in_space(const ShapeTable& shapes) {
    return !shapes.empty() && make_shape(shapes.front())->dimension() == 3;
}

void take_deeper(std::optional<Overlap>& worst, const Overlap& overlap) {
    if (overlap.depth > 0.0 && (!worst || overlap.share > worst->share)) worst = overlap;
}

void take_walls(std::optional<Overlap>& worst, const nscd::Bodies& bodies, const ShapeTable& shapes,
                const std::vector<nscd::Wall>& walls, const nscd::PeriodicBox& box) {
    if (walls.empty() || bodies.size() == 0) return;
    // With reach and share zero: points with g < 0.
    for (const nscd::ContactPoint& point :
         nscd::Detection(shapes, box).points(bodies, walls, Vec3{}, 0.0, 0.0)) {
        const auto b = static_cast<std::size_t>(point.b);
        if (point.wall < 0 || bodies.fixed[b]) continue;
        take_deeper(worst, {walls[static_cast<std::size_t>(point.wall)].key, bodies.id[b],
                            -point.gap, -point.gap / bodies.radius[b], true});
    }
}

}  // namespace

std::optional<Overlap> largest_overlap(const nscd::Bodies& bodies, const ShapeTable& shapes,
                                       const std::vector<nscd::Wall>& walls,
                                       const nscd::PeriodicBox& box) {
    std::vector<std::vector<Point2>> outlines;
    for (const ShapeRecord& shape : shapes) outlines.push_back(make_shape(shape)->outline());
    const auto at = [&](std::size_t i, const Vec3& place) {
        const Quaternion& q = bodies.orientation[i];
        return placed(outlines.at(static_cast<std::size_t>(bodies.shape[i])), {place[0], place[1]},
                      bodies.radius[i], angle_about_z(q));
    };
    const bool spheres = in_space(shapes);
    std::optional<Overlap> worst;
    for (const nscd::Pair& pair : nscd::candidate_pairs(bodies.position, bodies.radius, 0.0, box)) {
        const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
        if (bodies.fixed[a] && bodies.fixed[b]) continue;
        const Vec3 offset = box.minimum_image(bodies.position[b] - bodies.position[a]);
        const double depth = spheres ? bodies.radius[a] + bodies.radius[b] - norm(offset)
                                     : -surface_gap(at(a, Vec3{}), at(b, offset));
        const double share = depth / std::min(bodies.radius[a], bodies.radius[b]);
        take_deeper(worst, {bodies.id[a], bodies.id[b], depth, share});
    }
    take_walls(worst, bodies, shapes, walls, box);
    return worst;
}

}  // namespace turbidite::yade
