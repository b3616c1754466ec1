// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Spheres at walls in space. The place of a surface of revolution that is nearest to a centre lies
// in the half-plane of centre and axis, so gap and normal are those of a point (rho, h) and a
// straight meridian there: exact for cylinders, cones and rings, from both sides and at their rims.
// In the contact problem the wall is the half-space that touches it at this point.
#pragma once

#include <vector>

#include "granular_adapter/nscd/detection/contact_point.hpp"

namespace turbidite::nscd {

/// Throws std::invalid_argument for a segment, which is of the plane.
void check_space_wall(const Wall& wall);

/// Features: 0 on the surface, 1 and 2 at the rims of a round wall, 1 at the edges of a rectangle;
/// features_of_a_place more for each further point of a sphere that just fits into a round wall.
void sphere_wall(const WallView& view, std::vector<ContactPoint>& points);

}  // namespace turbidite::nscd
