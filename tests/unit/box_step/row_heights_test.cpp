// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/box_step/row_heights.hpp"

#include <gtest/gtest.h>

namespace turbidite {
namespace {

AxisOperator five_rows() {
    AxisOperator axis{5, 1.0, End::dirichlet, End::neumann};
    axis.sizes = {1.0, 1.0, 1.0, 1.0, 1.5};
    return axis;
}

AllRows all_rows(const AxisOperator& axis) {
    return AllRows({{4, 1.0, End::neumann, End::neumann}, axis});
}

TEST(RowHeights, OfEqualRowsAreExactlyTheSpacing) {
    const AxisOperator axis{5, 0.1, End::periodic, End::periodic};
    const RowHeights heights(axis, all_rows(axis));
    EXPECT_FALSE(heights.stretched());
    for (int j = -2; j < 7; ++j) {
        EXPECT_EQ(heights.size(j), 0.1);
        EXPECT_EQ(heights.relative(j), 1.0);
    }
    for (int j = 0; j <= 5; ++j) {
        EXPECT_EQ(heights.distance(j), 0.1);
        EXPECT_TRUE(heights.face(j).equal);
        EXPECT_EQ(heights.volume_shares(j).low, 0.5);
    }
}

TEST(RowHeights, AreMirroredBeyondSides) {
    const AxisOperator axis = five_rows();
    const RowHeights heights(axis, all_rows(axis));
    EXPECT_EQ(heights.size(-2), 1.0);
    EXPECT_EQ(heights.size(5), 1.5);
    EXPECT_EQ(heights.size(6), 1.0);
    EXPECT_EQ(heights.relative(4), 1.5);
    EXPECT_TRUE(heights.volume_shares(5).equal);
    EXPECT_FALSE(heights.over_distances(4, 1.0).equal);
}

TEST(RowHeights, BetweenTwoRowsGiveDistancesAndShares) {
    const AxisOperator axis = five_rows();
    const RowHeights heights(axis, all_rows(axis));
    EXPECT_TRUE(heights.face(2).equal);
    EXPECT_FALSE(heights.face(3).equal);  // its stencil reaches row 4
    EXPECT_EQ(heights.distance(4), 1.25);
    const FacePlace face = heights.face(4);
    EXPECT_DOUBLE_EQ(face.low, 0.5 / 1.25);
    EXPECT_DOUBLE_EQ(face.high, 0.75 / 1.25);
    EXPECT_DOUBLE_EQ(face.behind, 1.25);
    EXPECT_DOUBLE_EQ(face.ahead, 1.25 / 1.5);
}

}  // namespace
}  // namespace turbidite
