// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Distance between the surfaces of two grains that lie in the plane, for checks of packings. The
// contact engine has its own detection; this one is short rather than fast. Valid C++17.
#pragma once

#include "coupler/shapes/polygon_outline.hpp"

namespace turbidite {

/// A grain at its place. Round without corners.
struct PlacedOutline {
    Point2 centre{};
    double radius = 0.0;          ///< circumscribed
    std::vector<Point2> corners;  ///< at their places, counter-clockwise
};

/// `outline` has unit circumradius; `angle` is counter-clockwise [rad].
PlacedOutline placed(const std::vector<Point2>& outline, const Point2& centre, double radius,
                     double angle);

/// Least distance, or minus the least displacement that parts them [as the outlines].
double surface_gap(const PlacedOutline& one, const PlacedOutline& other);

/// Extent of the grain from its centre along +x, -x, +y, -y.
std::array<double, 4> reach(const PlacedOutline& grain);

}  // namespace turbidite
