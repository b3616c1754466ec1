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

// With fewer bodies than this, waking other threads takes as long as they save.
constexpr std::size_t threaded_bodies = 3000;

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
    ThreadTeam& team;
};

ThreadTeam& Detection::team_for(const Bodies& bodies) const {
    return bodies.size() < threaded_bodies ? *alone_ : *team_;
}

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

/// What visit(part, near) collects of everything near, in the order in which one thread meets it:
/// by parts, each of one thread, first of pairs and then of walls.
template <class Part, class Visit>
std::vector<Part> Detection::each_near(const Look& look, const Visit& visit) const {
    // With radii (1 + share) r, two bodies closer than `reach` have |d| < (1 + share)(r_a + r_b) +
    // reach: a gap below the alert distance of the pair.
    std::vector<double> wide = look.bodies.radius;
    for (double& radius : wide) radius *= 1.0 + look.share;
    const PairOrder order = order_ == ContactOrder::cells ? PairOrder::by_cell : PairOrder::by_body;
    const auto pairs =
        candidate_pairs(look.bodies.position, wide, look.reach, box_, order, look.team);
    const auto threads = static_cast<std::size_t>(look.team.size());
    std::vector<Part> parts(2 * threads);
    look.team.run([&](int number) {
        const auto thread = static_cast<std::size_t>(number);
        Part of_pairs, of_walls;  // of this thread alone: no cache line is shared while they grow
        for (const Pair& pair : pairs[thread]) visit(of_pairs, Near{pair.a, pair.b, -1});
        // Walls are few: each is tested with every body.
        const auto begin = look.team.part_begin(look.bodies.size(), number);
        const auto end = look.team.part_begin(look.bodies.size(), number + 1);
        for (auto i = static_cast<std::int32_t>(begin); i < static_cast<std::int32_t>(end); ++i)
            for (std::int32_t w = 0; w < static_cast<std::int32_t>(look.walls.size()); ++w)
                if (!look.bodies.fixed[i]) visit(of_walls, Near{-1, i, w});
        parts[thread] = std::move(of_pairs);
        parts[threads + thread] = std::move(of_walls);
    });
    return parts;
}

template <class Wanted>
std::vector<ContactPoint> Detection::unordered(const Look& look, const Wanted& wanted) const {
    using Points = std::vector<ContactPoint>;
    auto parts = each_near<Points>(look, [&](Points& points, const Near& near) {
        if (wanted(near)) add(look, near, points);
    });
    Points points = std::move(parts.front());
    for (std::size_t part = 1; part < parts.size(); ++part)
        points.insert(points.end(), parts[part].begin(), parts[part].end());
    return points;
}

/// How to find a point again, and what decides where it comes in the order.
template <class Place>
struct Detection::Found {
    Near near;
    std::size_t point;  ///< of the points of the pair
    Place place;
};

/// Round bodies have one point (or a few, at a wall into which they just fit), and it is cheaper to
/// find it twice, first for its place in the order, than to write all points down and move them
/// into their order.
template <class Order, class Wanted>
std::vector<ContactPoint> Detection::in_order(const Look& look, Order& order,
                                              const Wanted& wanted) const {
    // Points of polygons cost more to find again than to move.
    if (has_corners()) return sorted_by(order, unordered(look, wanted), look.team);
    struct Part {
        std::vector<Found<typename Order::Place>> found;
        std::vector<ContactPoint> pair;
    };
    const auto parts = each_near<Part>(look, [&](Part& part, const Near& near) {
        if (!wanted(near)) return;
        part.pair.clear();
        add(look, near, part.pair);
        for (std::size_t p = 0; p < part.pair.size(); ++p)
            part.found.push_back({near, p, order.place(part.pair[p])});
    });
    std::vector<std::pair<Near, std::size_t>> found;
    for (const Part& part : parts)
        for (const auto& [near, point, place] : part.found) {
            order.add(place);
            found.emplace_back(near, point);
        }
    const std::vector<std::int32_t> ordered = order.take(look.team);
    std::vector<ContactPoint> points(ordered.size());
    look.team.run([&](int thread) {
        std::vector<ContactPoint> pair;
        const std::size_t end = look.team.part_begin(points.size(), thread + 1);
        for (std::size_t i = look.team.part_begin(points.size(), thread); i < end; ++i) {
            const auto& [near, point] = found[static_cast<std::size_t>(ordered[i])];
            // The bodies have not moved since: the same points with the same numbers, in the same
            // order within the pair.
            pair.clear();
            add(look, near, pair);
            points[i] = pair[point];
        }
    });
    return points;
}

std::vector<ContactPoint> Detection::points(const Bodies& bodies, const std::vector<Wall>& walls,
                                            const Vec3& gravity, double reach, double share) const {
    return ordered_points({bodies, walls, gravity, reach, share}).points;
}

OrderedPoints Detection::ordered_points(const Search& search) const {
    const auto& [bodies, walls, gravity, reach, share, joined] = search;
    if (bodies.size() == 0) return {};
    const Look look{bodies,          walls, reach, share, narrow_.place(bodies, walls, joined),
                    team_for(bodies)};
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
    const Look look{bodies,
                    search.walls,
                    search.reach,
                    search.share,
                    narrow_.place(bodies, search.walls, search.joined),
                    *alone_};
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
    return deepest(
        unordered({bodies, walls, 0.0, 0.0, narrow_.place(bodies, walls), team_for(bodies)}, all));
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
