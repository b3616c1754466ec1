// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/soft/neighbours.hpp"

#include <gtest/gtest.h>

#include "tests/unit/soft/soft_case.hpp"

namespace turbidite::soft {
namespace {

const std::vector<nscd::Wall> floor_only = {{.point = {0, 0, 0}, .normal = {0, 1, 0}, .key = 2}};
constexpr double skin = 0.1;

struct Row {
    Row() {
        for (const GrainId id : {9, 4, 7})
            bodies.add(grain(disc, id, 2.0 + 1.05 * double(bodies.size()), 0.55));
    }
    std::vector<nscd::ContactKey> names() {
        std::vector<nscd::ContactKey> list;
        for (const Near& near : neighbours.of(bodies, floor_only)) list.push_back(near.name);
        return list;
    }
    nscd::Bodies bodies;
    Neighbours neighbours{{}, skin};
};

TEST(Neighbours, AreThoseWithinTheSkinInTheOrderOfTheirIds) {
    Row row;
    const std::vector<nscd::ContactKey> wanted = {
        {2, 4, 1, 0}, {2, 7, 1, 0}, {2, 9, 1, 0}, {4, 7, 0, 0}, {4, 9, 0, 0}};
    EXPECT_EQ(row.names(), wanted);
}

TEST(Neighbours, AreSoughtAgainWhenOneHasMovedByHalfTheSkin) {
    Row row;
    EXPECT_EQ(row.names().size(), 5u);
    row.bodies.position[2][0] += 0.49 * skin;  // away from its neighbour by 0.099: still listed
    EXPECT_EQ(row.names().size(), 5u);
    row.bodies.position[2][0] += 0.52 * skin;
    EXPECT_EQ(row.names().size(), 4u);
    row.bodies.position[2][1] += 2.0 * skin;
    EXPECT_EQ(row.names().size(), 3u);
    row.neighbours.forget();
    row.bodies.keep({0, 0, 0});
    EXPECT_TRUE(row.names().empty());
}

}  // namespace
}  // namespace turbidite::soft
