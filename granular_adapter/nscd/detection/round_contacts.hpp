// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Contact points of discs and spheres, whose surfaces have the same distance from the centre in
// every direction: the same in the plane and in space.
#pragma once

#include <vector>

#include "granular_adapter/nscd/detection/contact_point.hpp"

namespace turbidite::nscd {

void round_round(const PairView& view, std::vector<ContactPoint>& points);

/// The wall is solid behind its normal, and has no ends.
void round_half_space(const WallView& view, std::vector<ContactPoint>& points);

}  // namespace turbidite::nscd
