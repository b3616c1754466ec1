// SPDX-License-Identifier: GPL-3.0-or-later
#include "granular_adapter/yade/overlap.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "coupler/rigid/rotation.hpp"
#include "coupler/shapes/shape.hpp"
#include "coupler/shapes/surface_gap.hpp"
#include "granular_adapter/nscd/detection/broad_phase.hpp"

namespace turbidite::yade {
namespace {

bool in_space(const ShapeTable& shapes) {
    return !shapes.empty() && make_shape(shapes.front())->dimension() == 3;
}

}  // namespace

std::optional<Overlap> largest_overlap(const nscd::Bodies& bodies, const ShapeTable& shapes,
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
        if (depth > 0.0 && (!worst || share > worst->share))
            worst = Overlap{bodies.id[a], bodies.id[b], depth, share};
    }
    return worst;
}

}  // namespace turbidite::yade
