// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/detection/detection.hpp"

#include <algorithm>

#include "coupler/rigid/vec3.hpp"
#include "granular_adapter/nscd/cells/cell_order.hpp"

namespace turbidite::nscd {
namespace {

// Contacts whose heights differ by less than this fraction of the smallest radius count as side by
// side. Larger values mix layers, which costs sweeps.
constexpr double one_height = 0.01;

// Of the pairs that are near, on one rank every one is wanted.
constexpr auto all = [](const auto&) { return true; };

double deepest(const std::vector<ContactPoint>& points) {
    double overlap = 0.0;
    for (const ContactPoint& point : points) overlap = std::max(overlap, -point.gap);
    return overlap;
}

}  // namespace

void Detection::add_pair(const Bodies& bodies, Pair pair, double alert, const PlacedShapes& placed,
                         std::vector<ContactPoint>& points) const {
    if (bodies.fixed[pair.a] && bodies.fixed[pair.b]) return;
    // a is the body with the smaller id (contact_point.hpp), however the host stores them: keys of
    // the contact memory and names of features rely on it.
    if (bodies.id[pair.a] > bodies.id[pair.b]) std::swap(pair.a, pair.b);
    const Vec3 offset = box_.minimum_image(bodies.position[pair.b] - bodies.position[pair.a]);
    narrow_.pair({bodies, pair.a, pair.b, offset, alert, &placed}, points);
}

/// A pair of bodies, or a body b and a wall.
struct Detection::Near {
    std::int32_t a, b, wall;
};

/// One configuration and how far to look in it.
struct Detection::Look {
    const Bodies& bodies;
    const std::vector<Wall>& walls;
    double reach, share;
    PlacedShapes placed;
};

void Detection::add(const Look& look, const Near& near, std::vector<ContactPoint>& points) const {
    const std::vector<double>& radius = look.bodies.radius;
    // Alert distance of the pair, reach + share (r_a + r_b) [m]. A share of the largest radius
    // instead would put every pair of a fine fraction into the problem.
    if (near.wall < 0)
        return add_pair(look.bodies, {near.a, near.b},
                        look.reach + look.share * (radius[near.a] + radius[near.b]), look.placed,
                        points);
    narrow_.wall({look.bodies, near.b, look.walls[static_cast<std::size_t>(near.wall)], near.wall,
                  look.reach + look.share * 2.0 * radius[near.b], &look.placed},
                 points);
}

template <class Visit>
void Detection::each_near(const Look& look, const Visit& visit) const {
    // With radii (1 + share) r, two bodies closer than `reach` have |d| < (1 + share)(r_a + r_b) +
    // reach: a gap below the alert distance of the pair.
    std::vector<double> wide = look.bodies.radius;
    for (double& radius : wide) radius *= 1.0 + look.share;
    for (const Pair& pair : candidate_pairs(look.bodies.position, wide, look.reach, box_))
        visit(Near{pair.a, pair.b, -1});
    // Walls are few: each is tested with every body.
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(look.bodies.size()); ++i)
        for (std::int32_t w = 0; w < static_cast<std::int32_t>(look.walls.size()); ++w)
            if (!look.bodies.fixed[i]) visit(Near{-1, i, w});
}

template <class Wanted>
std::vector<ContactPoint> Detection::unordered(const Look& look, const Wanted& wanted) const {
    std::vector<ContactPoint> points;
    each_near(look, [&](const Near& near) {
        if (wanted(near)) add(look, near, points);
    });
    return points;
}

/// Round bodies have one point (or a few, at a wall into which they just fit), and it is cheaper to
/// find it twice, first for its place in the order, than to write all points down and move them
/// into their order.
template <class Order, class Wanted>
std::vector<ContactPoint> Detection::in_order(const Look& look, Order& order,
                                              const Wanted& wanted) const {
    // Points of polygons cost more to find again than to move.
    if (has_corners()) return sorted_by(order, unordered(look, wanted));
    struct Found {
        Near near;
        std::size_t point, of;  // of the points of the pair
    };
    std::vector<Found> found;
    std::vector<ContactPoint> pair;
    each_near(look, [&](const Near& near) {
        if (!wanted(near)) return;
        pair.clear();
        add(look, near, pair);
        for (std::size_t p = 0; p < pair.size(); ++p) {
            order.add(pair[p]);
            found.push_back({near, p, pair.size()});
        }
    });
    std::vector<ContactPoint> points;
    points.reserve(found.size());
    for (const std::int32_t i : order.take()) {
        const auto& [near, point, of] = found[static_cast<std::size_t>(i)];
        // The bodies have not moved since: the same points with the same numbers, in the same order
        // within the pair.
        if (of == 1) {
            add(look, near, points);
            continue;
        }
        pair.clear();
        add(look, near, pair);
        points.push_back(pair[point]);
    }
    return points;
}

std::vector<ContactPoint> Detection::points(const Bodies& bodies, const std::vector<Wall>& walls,
                                            const Vec3& gravity, double reach, double share) const {
    return ordered_points({bodies, walls, gravity, reach, share}).points;
}

OrderedPoints Detection::ordered_points(const Search& search) const {
    const auto& [bodies, walls, gravity, reach, share, joined] = search;
    if (bodies.size() == 0) return {};
    const Look look{bodies, walls, reach, share, narrow_.place(bodies, walls, joined)};
    const double band = one_height * *std::min_element(bodies.radius.begin(), bodies.radius.end());
    if (order_ == ContactOrder::cells && !has_corners()) {
        CellOrder order({bodies, walls, box_, gravity, reach, share, band});
        std::vector<ContactPoint> points = in_order(look, order, all);
        return {std::move(points), order.take_cells(), {}};
    }
    TopDownOrder order(bodies, gravity, band);
    return {in_order(look, order, all), {}, {}};
}

OrderedPoints Detection::ordered_points(const Search& search, const ParityGrid& grid,
                                        std::size_t own) const {
    const Bodies& bodies = search.bodies;
    const Look look{bodies, search.walls, search.reach, search.share,
                    narrow_.place(bodies, search.walls, search.joined)};
    // The smallest radius of all ranks: layers must not depend on which bodies this rank has.
    const double band = one_height * grid.sizes().smallest;
    CellOrder order({bodies, search.walls, box_, search.gravity, search.reach, search.share, band},
                    grid);
    const auto is_large = [&](std::int32_t body) { return grid.is_large(bodies.radius[body]); };
    // The owner of the body with the lower id finds the contact, at a wall the owner of the body;
    // so no two ranks do. Contacts of large bodies are of the first rank, whoever owns the other
    // body; only that rank has large bodies.
    const auto wanted = [&](const Near& near) {
        if (near.wall >= 0) return static_cast<std::size_t>(near.b) < own;
        const std::int32_t lower = bodies.id[near.a] < bodies.id[near.b] ? near.a : near.b;
        return static_cast<std::size_t>(lower) < own || is_large(near.a) || is_large(near.b);
    };
    std::vector<ContactPoint> points = in_order(look, order, wanted);
    return {std::move(points), order.take_cells(), order.take_phase_ends()};
}

double Detection::deepest_overlap(const Bodies& bodies, const std::vector<Wall>& walls) const {
    // With reach and share zero, only points with g < 0 are reported.
    return deepest(unordered({bodies, walls, 0.0, 0.0, narrow_.place(bodies, walls)}, all));
}

double Detection::deepest_overlap(const Bodies& bodies, const std::vector<Wall>& walls,
                                  const std::vector<ContactPoint>& of) const {
    const PlacedShapes placed = narrow_.place(bodies, walls);
    std::vector<ContactPoint> points;
    for (const ContactPoint& pair : of)
        if (pair.wall < 0)
            add_pair(bodies, {pair.a, pair.b}, 0.0, placed, points);
        else
            narrow_.wall({bodies, pair.b, walls[static_cast<std::size_t>(pair.wall)], pair.wall,
                          0.0, &placed},
                         points);
    return deepest(points);
}

}  // namespace turbidite::nscd
