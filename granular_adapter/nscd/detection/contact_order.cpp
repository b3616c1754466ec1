// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/detection/contact_order.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "granular_adapter/nscd/problem/vec3.hpp"

namespace turbidite::nscd {
namespace {

struct Place {
    double layer;        ///< an integer, increasing downwards
    std::int32_t point;  ///< index in the order of detection
    std::int32_t colour = 0;
};

bool above(const Place& a, const Place& b) {
    if (a.layer != b.layer) return a.layer < b.layer;
    return a.colour != b.colour ? a.colour < b.colour : a.point < b.point;
}

std::vector<Place> layers(const std::vector<ContactPoint>& points, const Bodies& bodies,
                          const Vec3& down, double band) {
    std::vector<Place> places;
    places.reserve(points.size());
    for (const ContactPoint& point : points) {
        const Vec3& centre = bodies.position[static_cast<std::size_t>(point.b)];
        const double depth = dot(down, centre) + dot(down, point.arm_b);
        places.push_back({std::floor(depth / band), static_cast<std::int32_t>(places.size())});
    }
    return places;
}

/// Greedy colouring: the first colour that neither body has in this layer; beyond 63, one shared
/// colour.
void colour(std::vector<Place>& places, const std::vector<ContactPoint>& points,
            std::size_t bodies) {
    struct Used {
        double layer = -INFINITY;
        std::uint64_t colours = 0;
    };
    std::vector<Used> used(bodies);
    for (Place& place : places) {
        const ContactPoint& point = points[static_cast<std::size_t>(place.point)];
        std::uint64_t taken = 0;
        for (const std::int32_t body : {point.a, point.b})
            if (body >= 0 && used[static_cast<std::size_t>(body)].layer == place.layer)
                taken |= used[static_cast<std::size_t>(body)].colours;
        place.colour = std::min(std::countr_one(taken), 63);
        for (const std::int32_t body : {point.a, point.b}) {
            if (body < 0) continue;
            Used& own = used[static_cast<std::size_t>(body)];
            if (own.layer != place.layer) own = {place.layer, 0};
            own.colours |= std::uint64_t{1} << place.colour;
        }
    }
}

}  // namespace

void order_top_down(std::vector<ContactPoint>& points, const Bodies& bodies, const Vec3& gravity,
                    double band) {
    const double weight = norm(gravity);
    if (weight == 0.0 || !(band > 0.0)) return;
    std::vector<Place> places = layers(points, bodies, (1.0 / weight) * gravity, band);
    std::sort(places.begin(), places.end(), above);
    colour(places, points, bodies.size());
    for (auto first = places.begin(); first != places.end();) {
        const auto same = [&](const Place& place) { return place.layer == first->layer; };
        const auto last = std::find_if_not(first, places.end(), same);
        if (last - first > 2) std::sort(first, last, above);
        first = last;
    }
    std::vector<ContactPoint> sorted;
    sorted.reserve(points.size());
    for (const Place& place : places)
        sorted.push_back(points[static_cast<std::size_t>(place.point)]);
    points = std::move(sorted);
}

}  // namespace turbidite::nscd
