// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Walls in the plane: half-planes and segments.
#pragma once

#include <vector>

#include "granular_adapter/nscd/detection/contact_point.hpp"

namespace turbidite::nscd {

/// Throws std::invalid_argument unless the wall is of the plane and moves in it.
void check_planar(const Wall& wall);

void disc_wall(const WallView& view, std::vector<ContactPoint>& points);

}  // namespace turbidite::nscd
