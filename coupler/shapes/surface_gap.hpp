// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Distance between the surfaces of two grains in the plane, for checks of packings. The contact
// engine has its own detection; this one is simple rather than fast. Valid C++17.
#pragma once

#include "coupler/shapes/polygon_outline.hpp"

namespace turbidite {

/// A grain in position; round if it has no corners.
struct PlacedOutline {
    Point2 centre{};
    double radius = 0.0;          ///< circumscribed
    std::vector<Point2> corners;  ///< in position, counter-clockwise
};

/// `outline` has unit circumradius; `angle` is counter-clockwise [rad].
PlacedOutline placed(const std::vector<Point2>& outline, const Point2& centre, double radius,
                     double angle);

/// Smallest distance, or minus the smallest displacement that separates them [unit of the
/// outlines].
double surface_gap(const PlacedOutline& one, const PlacedOutline& other);

/// Extent of the grain from its centre along +x, -x, +y, -y.
std::array<double, 4> reach(const PlacedOutline& grain);

}  // namespace turbidite
