// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/detection/broad_phase.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace turbidite::nscd {
namespace {

using PairSet = std::set<std::pair<int, int>>;

struct Cloud {
    std::vector<Vec3> x;
    std::vector<double> radii;
};

/// Radii are log-uniform in [largest / ratio, largest]. Without a depth all lie in a plane.
Cloud random_cloud(int count, double width, double ratio, unsigned seed, double depth = 0.0) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> place(0.0, width), exponent(0.0, 1.0), z(0.0, 1.0);
    Cloud cloud;
    for (int i = 0; i < count; ++i) {
        cloud.x.push_back({place(random), place(random), 0.0});
        cloud.radii.push_back(0.5 * std::pow(ratio, -exponent(random)));
        if (depth > 0.0) cloud.x.back()[2] = depth * z(random);
    }
    return cloud;
}

PairSet brute_force(const Cloud& cloud, double alert, const PeriodicBox& box) {
    PairSet pairs;
    for (int i = 0; i < int(cloud.x.size()); ++i)
        for (int j = i + 1; j < int(cloud.x.size()); ++j)
            if (norm(box.minimum_image(cloud.x[j] - cloud.x[i])) <
                cloud.radii[i] + cloud.radii[j] + alert)
                pairs.emplace(i, j);
    return pairs;
}

std::vector<std::pair<int, int>> listed(const std::vector<Pair>& pairs) {
    std::vector<std::pair<int, int>> result;
    for (const Pair& pair : pairs) result.emplace_back(pair.a, pair.b);
    return result;
}

/// The pairs of all threads, one after the other.
std::vector<Pair> shared_out(const Cloud& cloud, double alert, const PeriodicBox& box,
                             PairOrder order, int threads) {
    ThreadTeam team(threads);
    std::vector<Pair> all;
    for (const auto& part : candidate_pairs(cloud.x, cloud.radii, alert, box, order, team))
        all.insert(all.end(), part.begin(), part.end());
    return all;
}

/// In both orders, which any number of threads keep.
void expect_same(const Cloud& cloud, double alert, const PeriodicBox& box) {
    const PairSet expected = brute_force(cloud, alert, box);
    for (const PairOrder order : {PairOrder::by_body, PairOrder::by_cell}) {
        const auto found = listed(shared_out(cloud, alert, box, order, 1));
        EXPECT_EQ(PairSet(found.begin(), found.end()), expected);
        EXPECT_EQ(found.size(), expected.size()) << "a pair was found twice";
        EXPECT_EQ(listed(shared_out(cloud, alert, box, order, 3)), found);
    }
    EXPECT_EQ(listed(candidate_pairs(cloud.x, cloud.radii, alert, box)),
              listed(shared_out(cloud, alert, box, PairOrder::by_body, 1)));
}

// Widths from one cell to many; size ratios from one level to seven.
TEST(BroadPhase, FindsTheBruteForcePairs) {
    for (unsigned seed = 0; seed < 12; ++seed)
        for (const double ratio : {1.0, 3.0, 100.0})
            for (const double width : {1.5, 9.0, 60.0})
                expect_same(random_cloud(300, width, ratio, seed), 0.05 * seed, {});
}

TEST(BroadPhase, FindsTheBruteForcePairsAcrossPeriods) {
    for (unsigned seed = 0; seed < 12; ++seed)
        for (const double ratio : {1.0, 3.0, 100.0})
            for (const double width : {2.5, 9.0, 30.0}) {
                PeriodicBox box;
                box.length = {width, seed % 2 ? width : 0.0, 0.0};
                expect_same(random_cloud(300, width, ratio, seed), 0.05 * seed, box);
            }
}

TEST(BroadPhase, FindsTheBruteForcePairsInSpace) {
    for (unsigned seed = 0; seed < 8; ++seed)
        for (const double ratio : {1.0, 3.0, 100.0})
            for (const double width : {2.5, 6.0, 12.0}) {
                PeriodicBox box;
                box.length = {seed % 2 ? width : 0.0, 0.0, seed % 4 > 1 ? width : 0.0};
                expect_same(random_cloud(300, width, ratio, seed, width), 0.05 * seed, box);
            }
}

// Positions that are not wrapped give the same pairs as wrapped ones.
TEST(BroadPhase, TakesPositionsOutsideThePeriod) {
    PeriodicBox box;
    box.length = {9.0, 0.0, 0.0};
    Cloud cloud = random_cloud(300, 9.0, 3.0, 1);
    const PairSet expected = brute_force(cloud, 0.1, box);
    for (std::size_t i = 0; i < cloud.x.size(); i += 3) cloud.x[i][0] -= 18.0;
    expect_same(cloud, 0.1, box);
    EXPECT_EQ(brute_force(cloud, 0.1, box), expected);
}

// One body a million diameters away must neither require a million cells nor change the result.
TEST(BroadPhase, SurvivesAFarOutlier) {
    Cloud cloud = random_cloud(300, 20.0, 2.0, 4);
    cloud.x.push_back({1e6, -3e11, 0.0});
    cloud.radii.push_back(0.5);
    expect_same(cloud, 0.1, {});
}

TEST(BroadPhase, HandlesNoBodyAndOne) {
    EXPECT_TRUE(candidate_pairs({}, {}, 0.1, {}).empty());
    EXPECT_TRUE(candidate_pairs({{1, 1, 0}}, {0.5}, 0.1, {}).empty());
}

/// Whether these bodies are refused; `range` is that of the law.
bool refused(const std::vector<double>& radii, const std::vector<std::uint8_t>& fixed, double range,
             double period) {
    PeriodicBox box;
    box.length = {period, 0.0, 0.0};
    try {
        check_periods(radii, fixed, range, box);
    } catch (const std::invalid_argument&) {
        return true;
    }
    return false;
}

// Two discs of radius 0.5 in a period of 2 can touch on both sides (1 + 1 = 2 x 1); one disc of
// diameter 1 fits, and so do two that are both fixed.
TEST(BroadPhase, RefusesAPeriodInWhichPairsTouchTwice) {
    for (const double period : {1.9, 2.0}) {
        EXPECT_TRUE(refused({0.5, 0.5}, {0, 0}, 0.0, period));
        EXPECT_TRUE(refused({0.5, 0.5}, {0, 1}, 0.0, period));
        EXPECT_FALSE(refused({0.5, 0.5}, {1, 1}, 0.0, period));
        EXPECT_FALSE(refused({0.5}, {0}, 0.0, period));
    }
    EXPECT_FALSE(refused({0.5, 0.5}, {0, 0}, 0.0, 2.0001));
    EXPECT_TRUE(refused({0.5}, {0}, 0.0, 0.9)) << "a disc that overlaps with its image";
    // The largest two are fixed: the widest pair that can touch is 0.75 + 0.25.
    EXPECT_TRUE(refused({0.75, 0.5, 0.25}, {1, 1, 0}, 0.0, 2.0));
    EXPECT_FALSE(refused({0.75, 0.5, 0.25}, {1, 1, 0}, 0.0, 2.01));
}

// A law that reaches 0.3 acts on both sides up to a period of 2 x 1 + 2 x 0.3.
TEST(BroadPhase, RefusesAPeriodInWhichPairsAttractTwice) {
    EXPECT_TRUE(refused({0.5, 0.5}, {0, 0}, 0.3, 2.2));
    EXPECT_TRUE(refused({0.5, 0.5}, {0, 0}, 0.3, 2.5999));
    EXPECT_FALSE(refused({0.5, 0.5}, {0, 0}, 0.3, 2.6001));
    EXPECT_FALSE(refused({0.5}, {0}, 0.3, 1.0));
}

}  // namespace
}  // namespace turbidite::nscd
