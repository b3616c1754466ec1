// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/detection/contact_order.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "coupler/rigid/vec3.hpp"

namespace turbidite::nscd {
namespace {

// Layers are sorted by counting if there are at most this many per point, and otherwise by
// comparison.
constexpr double countable_layers = 8.0;

// Number of colours in one layer: the bits of a word.
constexpr int colours = 64;

using Place = TopDownOrder::Place;

/// Sorts from the top layer down, keeping the order of detection within a layer.
void sort_by_layer(std::vector<Place>& places) {
    const auto above = [](const Place& x, const Place& y) { return x.layer < y.layer; };
    const auto [top, bottom] = std::minmax_element(places.begin(), places.end(), above);
    const double first = top->layer, count = bottom->layer - first + 1.0;
    // A few bodies far apart would need an array of empty layers.
    if (!(count <= countable_layers * static_cast<double>(places.size())))
        return std::stable_sort(places.begin(), places.end(), above);
    std::vector<std::int32_t> next(static_cast<std::size_t>(count) + 1, 0);
    const auto layer = [first](const Place& p) {
        return static_cast<std::size_t>(p.layer - first);
    };
    for (const Place& place : places) ++next[layer(place) + 1];
    for (std::size_t i = 1; i < next.size(); ++i) next[i] += next[i - 1];
    std::vector<Place> sorted(places.size());
    for (const Place& place : places)
        sorted[static_cast<std::size_t>(next[layer(place)]++)] = place;
    places = std::move(sorted);
}

/// Greedy colouring of places sorted by layer: the first colour that neither body has in this
/// layer; beyond 63, one shared colour.
std::vector<std::uint8_t> colour(const std::vector<Place>& places, std::size_t bodies) {
    struct Used {
        double layer = -INFINITY;
        std::uint64_t colours = 0;
    };
    std::vector<Used> used(bodies);
    std::vector<std::uint8_t> result;
    result.reserve(places.size());
    for (const Place& place : places) {
        std::uint64_t taken = 0;
        for (const std::int32_t body : {place.a, place.b})
            // Walls (-1) are no shared bodies: each contact has a copy of its own.
            if (body >= 0 && used[static_cast<std::size_t>(body)].layer == place.layer)
                taken |= used[static_cast<std::size_t>(body)].colours;
        const int free = std::min(std::countr_one(taken), colours - 1);
        result.push_back(static_cast<std::uint8_t>(free));
        for (const std::int32_t body : {place.a, place.b}) {
            if (body < 0) continue;
            Used& own = used[static_cast<std::size_t>(body)];
            if (own.layer != place.layer) own = {place.layer, 0};
            own.colours |= std::uint64_t{1} << free;
        }
    }
    return result;
}

/// Calls visit(i) for the places [first, last) of one layer: by colour, and in their order within a
/// colour.
template <class Visit>
void by_colour(std::size_t first, std::size_t last, const std::vector<std::uint8_t>& colour,
               const Visit& visit) {
    std::uint64_t found = 0;
    for (std::size_t i = first; i < last; ++i) found |= std::uint64_t{1} << colour[i];
    for (; found != 0; found &= found - 1)
        for (std::size_t i = first; i < last; ++i)
            if (colour[i] == std::countr_zero(found)) visit(i);
}

}  // namespace

TopDownOrder::TopDownOrder(const Bodies& bodies, const Vec3& gravity, double band)
    : bodies_(bodies), band_(band) {
    const double weight = norm(gravity);
    sorts_ = weight > 0.0 && band > 0.0;
    if (sorts_) down_ = (1.0 / weight) * gravity;
}

TopDownOrder::Place TopDownOrder::place(const ContactPoint& point) const {
    double layer = 0.0;
    if (sorts_) {
        const Vec3& centre = bodies_.position[static_cast<std::size_t>(point.b)];
        // Depth of the point along gravity, in bands; from b, since a may be a wall.
        layer = std::floor((dot(down_, centre) + dot(down_, point.arm_b)) / band_);
    }
    return {layer, point.a, point.b, 0};
}

void TopDownOrder::add(Place place) {
    place.point = static_cast<std::int32_t>(places_.size());
    places_.push_back(place);
}

std::vector<std::int32_t> TopDownOrder::take(ThreadTeam&) {
    std::vector<std::int32_t> order;
    order.reserve(places_.size());
    if (sorts_ && !places_.empty()) sort_by_layer(places_);
    const std::vector<std::uint8_t> colours =
        sorts_ ? colour(places_, bodies_.size()) : std::vector<std::uint8_t>(places_.size(), 0);
    for (std::size_t first = 0, last = 0; first < places_.size(); first = last) {
        last = first + 1;
        while (last < places_.size() && places_[last].layer == places_[first].layer) ++last;
        by_colour(first, last, colours, [&](std::size_t i) { order.push_back(places_[i].point); });
    }
    places_.clear();
    return order;
}

}  // namespace turbidite::nscd
