// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The order of contacts by cells of eight parities.
#include <gtest/gtest.h>

#include <map>
#include <numeric>
#include <set>

#include "granular_adapter/nscd/cells/cell_order.hpp"
#include "spheres.hpp"

namespace turbidite::nscd {
namespace {

constexpr double share = 0.02, reach = 0.01;

/// Random spheres in a box of 40 x 30 x 40; every hundredth is large.
Bodies cloud(int count, double large = 0.5) {
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> any(0.0, 1.0);
    Bodies bodies;
    for (int i = 0; i < count; ++i)
        bodies.add(scenes::sphere(i + 1, {40 * any(random), 30 * any(random), 40 * any(random)},
                                  i % 100 == 99 ? large : 0.4 + 0.1 * any(random)));
    return bodies;
}

std::vector<ContactPoint> detected(const Bodies& bodies, const std::vector<Wall>& walls,
                                   const PeriodicBox& box = {}) {
    return Detection(scenes::spheres, box, ContactOrder::cells)
        .points(bodies, walls, {0.0, -1.0, 0.0}, reach, share);
}

CellScene scene(const Bodies& bodies, const std::vector<Wall>& walls, const PeriodicBox& box = {}) {
    return {bodies, walls, box, {0.0, -1.0, 0.0}, reach, share, 0.004};
}

bool share_a_body(const ContactPoint& p, const ContactPoint& q) {
    return p.b == q.b || (p.a >= 0 && (p.a == q.a || p.a == q.b)) || (q.a >= 0 && q.a == p.b);
}

std::array<std::uint64_t, 3> indices(const CellOrder::Cell& cell) {
    return {cell.x, cell.y, cell.z};
}

/// Pairs of contacts that share a body, in the order in which they are given.
template <class Visit>
void each_neighbours(const std::vector<ContactPoint>& points, const Visit& visit) {
    std::map<std::int32_t, std::vector<std::size_t>> of_body;
    for (std::size_t k = 0; k < points.size(); ++k)
        for (const std::int32_t body : {points[k].a, points[k].b})
            if (body >= 0) of_body[body].push_back(k);
    for (const auto& [body, list] : of_body)
        for (std::size_t i = 0; i < list.size(); ++i)
            for (std::size_t j = i + 1; j < list.size(); ++j) visit(list[i], list[j]);
}

// What ranks rely on: of two contacts that share a body, the one with the lower parity is swept
// first, and contacts of different cells with one parity share none.
TEST(CellOrder, NeighboursAreSweptByParity) {
    for (const bool periodic : {false, true}) {
        const Bodies bodies = cloud(20000);
        PeriodicBox box;
        if (periodic) box.length = {40.0, 0.0, 40.0};
        const std::vector<ContactPoint> points = detected(bodies, {}, box);
        ASSERT_GT(points.size(), 10000u);
        const CellOrder order(scene(bodies, {}, box));
        std::set<int> parities;
        std::set<std::array<std::uint64_t, 3>> cells;
        int crossing = 0;
        each_neighbours(points, [&](std::size_t i, std::size_t j) {
            ASSERT_TRUE(share_a_body(points[i], points[j]));
            const CellOrder::Cell first = order.cell(points[i]), second = order.cell(points[j]);
            parities.insert(first.parity()), cells.insert(indices(first));
            ASSERT_LE(first.parity(), second.parity());
            if (first.parity() != second.parity()) {
                ++crossing;
            } else {
                ASSERT_EQ(indices(first), indices(second));
            }
        });
        EXPECT_EQ(parities.size(), 8u);
        EXPECT_GT(cells.size(), 200u);
        EXPECT_GT(crossing, 1000);
    }
}

TEST(CellOrder, AnAxisThatRepeatsHasAnEvenNumberOfCellsOrOne) {
    for (const double length : {7.0, 12.0, 17.0, 29.0, 41.0}) {
        const Bodies bodies = cloud(2000);
        PeriodicBox box;
        box.length = {length, 0.0, 0.0};
        const CellOrder order(scene(bodies, {}, box));
        std::set<std::uint64_t> along;
        for (std::int32_t i = 0; i < 2000; ++i) {
            ContactPoint point;
            point.b = i;
            if (bodies.position[i][0] < length) along.insert(order.cell(point).x);
        }
        const std::size_t count = along.size();
        EXPECT_TRUE(count == 1 || count % 2 == 0) << length << ": " << count;
        // L = 5 (2 r_max 1.02 + 0.01) is at most 5.15.
        EXPECT_EQ(count, std::max<std::size_t>(static_cast<std::size_t>(length / 5.15) / 2 * 2, 1));
    }
}

// Within a cell higher contacts come first.
TEST(CellOrder, ACellIsSweptFromTheTopDown) {
    const Bodies bodies = cloud(20000);
    const std::vector<ContactPoint> points = detected(bodies, {});
    const CellOrder order(scene(bodies, {}));
    int pairs = 0;
    for (std::size_t k = 1; k < points.size(); ++k) {
        if (indices(order.cell(points[k - 1])) != indices(order.cell(points[k]))) continue;
        const auto height = [&](const ContactPoint& p) {
            return bodies.position[p.b][1] + p.arm_b[1];
        };
        EXPECT_GT(height(points[k - 1]), height(points[k]) - 0.005);
        ++pairs;
    }
    EXPECT_GT(pairs, 1000);
}

// Large bodies neither enlarge the cells nor wait for any: their contacts come last.
TEST(CellOrder, ContactsOfLargeBodiesAreAClassOfTheirOwn) {
    const Bodies small = cloud(5000, 0.45), mixed = cloud(5000, 3.0);
    const std::vector<Wall> walls = {scenes::floor(0.3)};
    const std::vector<ContactPoint> points = detected(mixed, walls);
    const CellOrder order(scene(mixed, walls)), plain(scene(small, walls));
    int large = 0;
    for (const ContactPoint& point : points) {
        const bool is_large =
            mixed.radius[point.b] == 3.0 || (point.a >= 0 && mixed.radius[point.a] == 3.0);
        ASSERT_EQ(order.cell(point).parity() == 8, is_large);
        ASSERT_TRUE(is_large || large == 0) << "behind all others";
        large += is_large;
        if (!is_large) {
            ASSERT_EQ(indices(order.cell(point)), indices(plain.cell(point)));
        }
    }
    EXPECT_GT(large, 100);
    EXPECT_LT(large, static_cast<int>(points.size()) - 100);
}

// Detection by several threads, of pairs, walls and the class of large bodies.
TEST(CellOrder, ThreadsFindTheSamePointsInTheSameOrder) {
    const Bodies bodies = cloud(20000, 3.0);
    const std::vector<Wall> walls = {scenes::floor(0.3)};
    PeriodicBox box;
    box.length = {40.0, 0.0, 40.0};
    const Detection::Search search{bodies, walls, {0.0, -1.0, 0.0}, reach, share};
    const auto found = [&](int threads) {
        return Detection(scenes::spheres, box, ContactOrder::cells, threads).ordered_points(search);
    };
    const OrderedPoints one = found(1);
    std::size_t at_walls = 0;
    for (const ContactPoint& point : one.points) at_walls += point.wall >= 0;
    EXPECT_GT(at_walls, 100u);
    EXPECT_GT(one.points.size(), 10000u);
    EXPECT_GT(one.cells.size(), 100u);
    for (const int threads : {2, 3}) {
        const OrderedPoints several = found(threads);
        EXPECT_EQ(several.cells.place, one.cells.place);
        EXPECT_EQ(several.cells.end, one.cells.end);
        ASSERT_EQ(several.points.size(), one.points.size());
        for (std::size_t k = 0; k < one.points.size(); ++k) {
            const ContactPoint &p = several.points[k], &q = one.points[k];
            ASSERT_EQ(std::tie(p.a, p.b, p.wall, p.gap, p.normal),
                      std::tie(q.a, q.b, q.wall, q.gap, q.normal));
        }
    }
}

// Bodies stored in another order: the same contacts in the same order, and bitwise the same motion.
TEST(CellOrder, StorageDoesNotMatter) {
    std::vector<std::size_t> order(5 * 5 * 6);
    std::iota(order.begin(), order.end(), 0);
    std::mt19937_64 random(2);
    std::shuffle(order.begin(), order.end(), random);
    EngineSettings settings = scenes::exact_in_space(0.3, 1e-4);
    Engine plain = scenes::settling_spheres(5, 6, settings);
    Engine shuffled = scenes::settling_spheres(5, 6, settings, order);
    for (Engine* engine : {&plain, &shuffled}) {
        for (Twist& twist : engine->bodies().twist) twist.velocity[1] = -1.0;
        EXPECT_TRUE(scenes::run(*engine, 1.0, 0.01));
    }
    ASSERT_EQ(plain.points().size(), shuffled.points().size());
    EXPECT_GT(plain.memory().contacts().size(), 100u);
    for (std::size_t k = 0; k < plain.points().size(); ++k)
        ASSERT_EQ(plain.impulses()[k], shuffled.impulses()[k]);
    const Bodies &a = plain.bodies(), &b = shuffled.bodies();
    for (std::size_t i = 0; i < b.size(); ++i) {
        ASSERT_EQ(b.id[i], a.id[order[i]]);
        EXPECT_EQ(b.position[i], a.position[order[i]]);
        EXPECT_EQ(b.orientation[i], a.orientation[order[i]]);
        EXPECT_EQ(b.twist[i], a.twist[order[i]]);
    }
}

}  // namespace
}  // namespace turbidite::nscd
