// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/shapes/surface_gap.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace turbidite {
namespace {

const std::vector<Point2> square = {{M_SQRT1_2, M_SQRT1_2},
                                    {-M_SQRT1_2, M_SQRT1_2},
                                    {-M_SQRT1_2, -M_SQRT1_2},
                                    {M_SQRT1_2, -M_SQRT1_2}};

PlacedOutline unit_square(double x, double y, double angle = 0.0) {
    return placed(square, {x, y}, M_SQRT1_2, angle);
}

TEST(SurfaceGap, OfSquares) {
    const PlacedOutline a = unit_square(0, 0);
    EXPECT_NEAR(surface_gap(a, unit_square(1.25, 0.3)), 0.25, 1e-15);
    EXPECT_NEAR(surface_gap(a, unit_square(1.3, 1.4)), 0.5, 1e-15);   // corners, (0.3, 0.4)
    EXPECT_NEAR(surface_gap(a, unit_square(0.9, 0.3)), -0.1, 1e-15);  // overlap
    EXPECT_NEAR(surface_gap(a, unit_square(0.0, 0.0)), -1.0, 1e-15);  // the same place
    EXPECT_NEAR(surface_gap(a, unit_square(2.0, 0.0, M_PI / 4)), 1.5 - M_SQRT1_2, 1e-15);
}

TEST(SurfaceGap, OfSquareAndDisc) {
    const PlacedOutline a = unit_square(0, 0);
    EXPECT_NEAR(surface_gap(a, {{1.0, 0.2}, 0.25, {}}), 0.25, 1e-15);
    EXPECT_NEAR(surface_gap({{0.8, 0.9}, 0.2, {}}, a), 0.3, 1e-15);   // corner, (0.3, 0.4)
    EXPECT_NEAR(surface_gap(a, {{0.4, 0.1}, 0.2, {}}), -0.3, 1e-15);  // centre inside
    EXPECT_NEAR(surface_gap({{0, 0}, 0.5, {}}, {{1.2, 1.6}, 1.0, {}}), 0.5, 1e-15);
}

TEST(SurfaceGap, OfPlateAndWhatLiesOnItsLine) {
    const PlacedOutline plate{{1.0, 2.0}, 1.0, {{0.0, 2.0}, {2.0, 2.0}}};
    EXPECT_NEAR(surface_gap(plate, {{6.0, 2.0}, 0.5, {}}), 3.5, 1e-15);
    EXPECT_NEAR(surface_gap({{-1.0, 2.0}, 0.5, {}}, plate), 0.5, 1e-15);
    EXPECT_NEAR(surface_gap(plate, {{1.5, 2.0}, 0.5, {}}), -0.5, 1e-15);  // cut in the middle
    EXPECT_NEAR(surface_gap(plate, unit_square(3.0, 2.0)), 0.5, 1e-15);
}

TEST(SurfaceGap, ReachFollowsTheAngle) {
    const auto flat = reach(unit_square(3, 4));
    for (const double r : flat) EXPECT_NEAR(r, 0.5, 1e-15);
    const auto tilted = reach(unit_square(3, 4, M_PI / 4));
    for (const double r : tilted) EXPECT_NEAR(r, M_SQRT1_2, 1e-15);
}

}  // namespace
}  // namespace turbidite
