// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Contact points of polygons with polygons, discs and walls, as entries for the table of
// narrow_phase.hpp.
//
// Features: 2 k for corner k of the body with the smaller id (or of a wall), 2 k + 1 for corner k
// of the other; against discs, 2 k for side k and 2 k + 1 for corner k. They depend neither on the
// order of the bodies nor on which polygon is the reference of a manifold.
#pragma once

#include <vector>

#include "granular_adapter/nscd/detection/contact_point.hpp"

namespace turbidite::nscd {

void polygon_polygon(const PairView& view, std::vector<ContactPoint>& points);

/// Body a is the disc.
void disc_polygon(const PairView& view, std::vector<ContactPoint>& points);

void polygon_wall(const WallView& view, std::vector<ContactPoint>& points);

}  // namespace turbidite::nscd
