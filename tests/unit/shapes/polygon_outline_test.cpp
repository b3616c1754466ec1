// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/shapes/polygon_outline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

namespace turbidite {
namespace {

std::string refusal(const std::vector<double>& coordinates) {
    try {
        normalised_outline(coordinates);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "accepted";
}

void expect_refused(const std::vector<double>& coordinates, const std::string& part) {
    EXPECT_NE(refusal(coordinates).find(part), std::string::npos) << refusal(coordinates);
}

// A 4 x 3 rectangle far from the origin: centre (102, 201.5), circumradius 2.5, area 12,
// second moment 12 (16 + 9)/12 = 25.
TEST(PolygonOutline, IsCentredAndScaled) {
    const std::vector<double> rectangle = {100, 200, 104, 200, 104, 203, 100, 203};
    const Outline outline = normalised_outline(rectangle);
    EXPECT_NEAR(outline.centre[0], 102.0, 1e-12);
    EXPECT_NEAR(outline.centre[1], 201.5, 1e-12);
    EXPECT_NEAR(outline.radius, 2.5, 1e-12);
    EXPECT_FALSE(outline.turned_round);
    ASSERT_EQ(outline.vertices.size(), 4u);
    EXPECT_NEAR(outline.vertices[0][0], -0.8, 1e-12);
    EXPECT_NEAR(outline.vertices[0][1], -0.6, 1e-12);
    const AreaMoments moments = area_moments({{100, 200}, {104, 200}, {104, 203}, {100, 203}});
    EXPECT_NEAR(moments.area, 12.0, 1e-12);
    EXPECT_NEAR(moments.second, 25.0, 1e-10);
}

// The centre of a right triangle is a third of the way up, not in the middle of its circumscribed
// circle.
TEST(PolygonOutline, IsCentredOnTheCentreOfMass) {
    const Outline outline = normalised_outline({0, 0, 3, 0, 0, 3});
    EXPECT_NEAR(outline.centre[0], 1.0, 1e-15);
    EXPECT_NEAR(outline.centre[1], 1.0, 1e-15);
    EXPECT_NEAR(outline.radius, std::sqrt(5.0), 1e-15);
}

TEST(PolygonOutline, ReversesClockwiseOutlines) {
    const Outline outline = normalised_outline({0, 0, 0, 1, 1, 1, 1, 0});
    EXPECT_TRUE(outline.turned_round);
    EXPECT_GT(area_moments(outline.vertices).area, 0.0);
    const Outline straight = normalised_outline({0, 0, 1, 0, 1, 1, 0, 1});
    EXPECT_EQ(outline.vertices, straight.vertices);
}

TEST(PolygonOutline, NamesTheOffendingVertex) {
    expect_refused({0, 0, 1, 0}, "2 vertices; at least 3");
    expect_refused({0, 0, 1, 0, 1}, "5 numbers");
    expect_refused({0, 0, 1, 0, 1, 1, 1, 0}, "vertex 4 (1, 0) is the same as vertex 2");
    expect_refused({0, 0, 1, 1, 3, 3}, "area is zero");
    expect_refused({0, 0, 2, 0, 1, 0.5, 2, 2, 0, 2}, "vertex 3 (1, 0.5) makes it concave");
    expect_refused({0, 0, 1, 0, 2, 0, 1, 2}, "vertex 2 (1, 0) is collinear");
    expect_refused({0, 0, 1, 0, std::nan(""), 1}, "vertex 3");
    // The same concave outline clockwise: the error names the vertex as the user wrote it.
    expect_refused({0, 0, 0, 2, 2, 2, 1, 0.5, 2, 0}, "(1, 0.5) makes it concave");
}

// A five-pointed star drawn in one stroke turns left at every corner, but is not a convex polygon.
TEST(PolygonOutline, RefusesAStar) {
    std::vector<double> star;
    for (int k = 0; k < 5; ++k) {
        star.push_back(std::cos(4.0 * M_PI * k / 5.0));
        star.push_back(std::sin(4.0 * M_PI * k / 5.0));
    }
    expect_refused(star, "intersects itself");
}

}  // namespace
}  // namespace turbidite
