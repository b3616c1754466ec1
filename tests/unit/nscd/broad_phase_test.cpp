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

/// Radii are log-uniform in [largest / ratio, largest].
Cloud random_cloud(int count, double width, double ratio, unsigned seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> place(0.0, width), exponent(0.0, 1.0);
    Cloud cloud;
    for (int i = 0; i < count; ++i) {
        cloud.x.push_back({place(random), place(random), 0.0});
        cloud.radii.push_back(0.5 * std::pow(ratio, -exponent(random)));
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

void expect_same(const Cloud& cloud, double alert, const PeriodicBox& box) {
    const std::vector<Pair> found = candidate_pairs(cloud.x, cloud.radii, alert, box);
    PairSet unique;
    for (const Pair& pair : found) unique.emplace(pair.a, pair.b);
    EXPECT_EQ(unique.size(), found.size()) << "a pair was found twice";
    EXPECT_EQ(unique, brute_force(cloud, alert, box));
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

// Two discs of radius 0.5 in a period of 1.9 can touch on both sides (0.95 + 0.95 < 2 x 1); one
// disc of diameter 1 fits.
TEST(BroadPhase, RefusesAPeriodInWhichPairsTouchTwice) {
    PeriodicBox box;
    box.length = {1.9, 0.0, 0.0};
    EXPECT_THROW(check_periods({0.5, 0.5}, box), std::invalid_argument);
    EXPECT_NO_THROW(check_periods({0.5}, box));
    box.length = {2.0, 0.0, 0.0};
    EXPECT_NO_THROW(check_periods({0.5, 0.5}, box));
}

}  // namespace
}  // namespace turbidite::nscd
