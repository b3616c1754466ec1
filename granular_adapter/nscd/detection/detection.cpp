// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/detection/detection.hpp"

#include <algorithm>

#include "granular_adapter/nscd/detection/contact_order.hpp"
#include "granular_adapter/nscd/problem/vec3.hpp"

namespace turbidite::nscd {
namespace {

// Contacts whose heights differ by less than this fraction of the smallest radius count as side by
// side. Larger values mix layers, which costs sweeps.
constexpr double one_height = 0.01;

double deepest(const std::vector<ContactPoint>& points) {
    double overlap = 0.0;
    for (const ContactPoint& point : points) overlap = std::max(overlap, -point.gap);
    return overlap;
}

}  // namespace

void Detection::add_pair(const Bodies& bodies, Pair pair, double alert,
                         const PlacedPolygons& polygons, std::vector<ContactPoint>& points) const {
    if (bodies.fixed[pair.a] && bodies.fixed[pair.b]) return;
    if (bodies.id[pair.a] > bodies.id[pair.b]) std::swap(pair.a, pair.b);
    const Vec3 offset = box_.minimum_image(bodies.position[pair.b] - bodies.position[pair.a]);
    narrow_.pair({bodies, pair.a, pair.b, offset, alert, &polygons}, points);
}

std::vector<ContactPoint> Detection::unordered(const Bodies& bodies, const std::vector<Wall>& walls,
                                               double reach, double share) const {
    const PlacedPolygons polygons = narrow_.place(bodies);
    std::vector<double> wide = bodies.radius;
    for (double& radius : wide) radius *= 1.0 + share;
    const std::vector<Pair> pairs = candidate_pairs(bodies.position, wide, reach, box_);
    std::vector<ContactPoint> points;
    points.reserve(pairs.size());
    for (const Pair& pair : pairs)
        add_pair(bodies, pair, reach + share * (bodies.radius[pair.a] + bodies.radius[pair.b]),
                 polygons, points);
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(bodies.size()); ++i)
        for (std::int32_t w = 0; w < static_cast<std::int32_t>(walls.size()); ++w)
            if (!bodies.fixed[i])
                narrow_.wall({bodies, i, walls[static_cast<std::size_t>(w)], w,
                              reach + share * 2.0 * bodies.radius[i], &polygons},
                             points);
    return points;
}

std::vector<ContactPoint> Detection::points(const Bodies& bodies, const std::vector<Wall>& walls,
                                            const Vec3& gravity, double reach, double share) const {
    std::vector<ContactPoint> points = unordered(bodies, walls, reach, share);
    const auto smallest = std::min_element(bodies.radius.begin(), bodies.radius.end());
    if (!points.empty()) order_top_down(points, bodies, gravity, one_height * *smallest);
    return points;
}

double Detection::deepest_overlap(const Bodies& bodies, const std::vector<Wall>& walls) const {
    return deepest(unordered(bodies, walls, 0.0, 0.0));
}

double Detection::deepest_overlap(const Bodies& bodies, const std::vector<Wall>& walls,
                                  const std::vector<ContactPoint>& of) const {
    const PlacedPolygons polygons = narrow_.place(bodies);
    std::vector<ContactPoint> points;
    for (const ContactPoint& pair : of)
        if (pair.wall < 0)
            add_pair(bodies, {pair.a, pair.b}, 0.0, polygons, points);
        else
            narrow_.wall({bodies, pair.b, walls[static_cast<std::size_t>(pair.wall)], pair.wall,
                          0.0, &polygons},
                         points);
    return deepest(points);
}

}  // namespace turbidite::nscd
