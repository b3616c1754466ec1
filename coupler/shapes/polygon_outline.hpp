// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Vertices of a convex polygon, checked and converted to the form of ShapeRecord: counter-clockwise
// about the centre of mass, circumscribed radius 1. Valid C++17.
#pragma once

#include <array>
#include <vector>

namespace turbidite {

using Point2 = std::array<double, 2>;

/// Area, centre of mass and polar moment about it, of density 1.
struct AreaMoments {
    double area = 0.0;    ///< [m2]; negative if the vertices are clockwise
    Point2 centre{};      ///< [m]
    double second = 0.0;  ///< integral of |x - centre|^2 [m4]
};
AreaMoments area_moments(const std::vector<Point2>& vertices);

struct Outline {
    std::vector<Point2> vertices;  ///< unit circumradius
    Point2 centre{};               ///< of mass, as given
    double radius = 1.0;           ///< circumscribed about the centre, as given
    bool turned_round = false;     ///< they were given clockwise
};

/// x, y, x, y, ... in any unit. Throws std::invalid_argument naming the vertex (the first is 1) if
/// fewer than three are given, one is repeated, is collinear with its neighbours, or makes the
/// outline concave or self-intersecting.
Outline normalised_outline(const std::vector<double>& coordinates);

/// Corners of the equilateral triangle with one side at the bottom.
std::vector<double> equilateral_triangle();

}  // namespace turbidite
