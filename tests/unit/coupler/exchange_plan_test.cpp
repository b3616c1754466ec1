// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "coupler/hub/exchange_plan.hpp"
#include "coupler/protocol/failure.hpp"

namespace turbidite {
namespace {

GrainState grain(GrainId id, double x) {
    GrainState g;
    g.id = id;
    g.radius = 0.5;
    g.position = {x, 0.0, 0.0};
    return g;
}

Kick kick(GrainId id) {
    Kick k;
    k.id = id;
    return k;
}

// Two fluid ranks share [0, 10] and look 0.2 further; a grain at 4.8 with radius 0.5 touches both
// boxes, one at 4.2 only the left one (4.2 + 0.5 < 4.8).
TEST(ExchangePlan, AGrainGoesToEveryFluidRankItTouches) {
    const ExchangePlan plan({{{-0.2, -1, -1}, {5.2, 1, 1}}, {{4.8, -1, -1}, {10.2, 1, 1}}}, {});
    const Motion motion{{grain(1, 4.8), grain(2, 4.2), grain(3, 9.0)}, {}};
    const auto routed = plan.by_place(motion);
    EXPECT_EQ(routed[0].places, (std::vector<std::uint32_t>{0, 1}));
    EXPECT_EQ(routed[1].places, (std::vector<std::uint32_t>{0, 2}));
}

// Period 10: the grain at 9.8 also touches the left rank, as its image at -0.2.
TEST(ExchangePlan, PeriodicImagesAreRouted) {
    const ExchangePlan plan({{{0, -1, -1}, {5, 1, 1}}, {{5, -1, -1}, {10, 1, 1}}}, {10, 0, 0});
    const Motion motion{{grain(1, 9.8)}, {}};
    EXPECT_EQ(plan.by_place(motion)[0].places.size(), 1u);
    // Positions may run on across the side.
    for (const double x : {-10.2, 29.8, 1009.8}) {
        const auto routed = plan.by_place({{grain(1, x)}, {}});
        EXPECT_EQ(routed[0].places.size(), 1u) << x;
        EXPECT_EQ(routed[1].places.size(), 1u) << x;
    }
}

TEST(ExchangePlan, PlacesAreFoundAnewOnlyWhenGrainsMigrateAppearOrVanish) {
    ExchangePlan plan({}, {});
    const Motion one{{grain(1, 0)}, {}}, two{{grain(2, 1)}, {}}, none{},
        both{{grain(1, 0), grain(2, 1)}, {}};
    for (int window = 0; window < 3; ++window) plan.gather({one, two});
    EXPECT_EQ(plan.builds(), 1);
    plan.gather({both, none});  // 2 migrates: another owner at the same place
    EXPECT_EQ(plan.builds(), 1);
    EXPECT_EQ(plan.by_owner(std::vector{kick(1), kick(2)})[0].size(), 2u);
    EXPECT_EQ(plan.gather({two, one}).grains.front().id, 1) << "in the order of the ids";
    EXPECT_EQ(plan.builds(), 1);
    EXPECT_EQ(plan.by_owner(std::vector{kick(1), kick(2)})[1].at(0).id, 1);
    plan.gather({two, none});
    EXPECT_EQ(plan.builds(), 2);
}

TEST(ExchangePlan, KicksReturnToTheOwnersForAnyIds) {
    ExchangePlan plan({}, {});
    const GrainId huge = GrainId{1} << 60;  // ids are identifiers, not array indices
    plan.gather({{{grain(huge, 0)}, {}}, {{grain(-3, 1), grain(7, 2)}, {}}});
    const auto routed = plan.by_owner(std::vector{kick(7), kick(huge), kick(-3)});
    ASSERT_EQ(routed.size(), 2u);
    EXPECT_EQ(routed[0][0].id, huge);
    EXPECT_EQ(routed[1].size(), 2u);
}

// std::max(0, nan) is 0: the ledger would not notice.
TEST(ExchangePlan, AReportThatIsNotANumberStaysOne) {
    ExchangePlan plan({}, {});
    std::vector<Motion> shares(2);
    shares[0].report.max_penetration = std::nan("");
    shares[1].report.max_penetration = 0.1;
    EXPECT_TRUE(std::isnan(plan.gather(shares).report.max_penetration));
}

ContactRecord contact(GrainId a, GrainId b, int feature = 0) {
    ContactRecord c;
    c.a = a;
    c.b = b;
    c.feature = feature;
    return c;
}

// The list of contacts is the same for any distribution of the grains.
TEST(ExchangePlan, ContactsAreGatheredInOneOrder) {
    ExchangePlan plan({}, {});
    ContactRecord floor = contact(77, 2);  // the id of a has no meaning at a wall
    floor.wall = 2;
    const std::vector<ContactRecord> left = {floor, contact(1, 2, 1), contact(1, 2)};
    const Motion all = plan.gather(
        {{{grain(1, 0), grain(2, 1)}, {}, left}, {{grain(3, 2)}, {}, std::vector{contact(1, 3)}}});
    ASSERT_EQ(all.contacts->size(), 4u);
    EXPECT_EQ(all.contacts->at(0).feature, 0);
    EXPECT_EQ(all.contacts->at(1).feature, 1);
    EXPECT_EQ(all.contacts->at(2).b, 3);
    EXPECT_EQ(all.contacts->at(3).wall, 2);
    EXPECT_FALSE(plan.gather({{{grain(1, 0)}, {}}, {{grain(2, 1)}, {}}}).contacts);
}

// An adapter without a residual leaves it to the others; if no adapter has one, it stays empty.
TEST(ExchangePlan, EmptyMeasuresStayEmpty) {
    ExchangePlan plan({}, {});
    std::vector<Motion> shares(2);
    shares[1].report.quad = 0.25;
    const ContactReport report = plan.gather(shares).report;
    EXPECT_FALSE(report.residual);
    EXPECT_EQ(report.quad, 0.25);
}

TEST(ExchangePlan, MissingDuplicateAndUnknownAnswersAreRefused) {
    ExchangePlan plan({}, {});
    plan.gather({{{grain(1, 0), grain(2, 1)}, {}}});
    EXPECT_THROW(plan.by_owner(std::vector{kick(1)}), PhysicsRefused);
    EXPECT_THROW(plan.by_owner(std::vector{kick(1), kick(2), kick(2)}), PhysicsRefused);
    EXPECT_THROW(plan.by_owner(std::vector{kick(1), kick(2), kick(3)}), PhysicsRefused);
    EXPECT_THROW(plan.gather({{{grain(1, 0)}, {}}, {{grain(1, 0)}, {}}}), PhysicsRefused);
}

TEST(ExchangePlan, SharesAreEvenAndComplete) {
    std::vector<GrainState> population;
    for (int i = 0; i < 7; ++i) population.push_back(grain(i, 7 - i));
    const auto shares = shares_of(population, 3);
    std::size_t total = 0;
    for (const Motion& share : shares) {
        EXPECT_GE(share.grains.size(), 2u);
        EXPECT_LE(share.grains.size(), 3u);
        total += share.grains.size();
    }
    EXPECT_EQ(total, 7u);
    EXPECT_LT(shares[0].grains.back().position[0], shares[1].grains.front().position[0]);
}

}  // namespace
}  // namespace turbidite
