// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/shapes/tight_wall.hpp"

#include <algorithm>
#include <cmath>

namespace turbidite {
namespace {

/// The largest |n_y| of its normals.
double upright_normal(const WallSurface& surface) {
    const double along = std::abs(surface.normal[1]);
    if (!surface.round) return along;
    // The normals of a meridian (wider, height) are (height, -wider) over its length, turned about
    // the axis: their parts normal to it reach sqrt(1 - a_y^2) along y, those along it have a_y.
    const BesideAxis meridian = surface.meridian[1] - surface.meridian[0];
    const double across = std::sqrt(std::max(0.0, 1.0 - along * along));
    return (std::abs(meridian.height) * across + std::abs(meridian.radius) * along) /
           norm(meridian);
}

}  // namespace

WallSurface surface_of_plate(const Vec3& from, const Vec3& to) {
    SpaceWallShape plate;
    plate.place = from;
    plate.a = to - from;
    plate.b = {0.0, 0.0, 1.0};
    return surface_of(plate);
}

double least_thickness(const WallSurface& surface, double thickness, const MeshRows& rows) {
    const double upright = std::min(1.0, upright_normal(surface));
    // Of its faces: round edges, as far beyond, lie in what begins there.
    const double top = extent_of(surface, 0.5 * thickness * upright).high[1];
    return least_cells_of_wall * std::max(rows.height, rows.height_at(top) * upright);
}

bool is_too_thin(double thickness, double least) {
    return thickness < least * (1.0 - 1e-6);
}

}  // namespace turbidite
