// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Walls that meet, such as the plates of a hopper. Beside their common edge a round body has a
// contact with the face of one and with the edge of the other. As obstacles both may stay, but what
// acts across a gap, adhesion and films of liquid, acts between the body and the place of the
// joined surface that is nearest, and would act twice. The place of a wall that is nearest is
//
//     foot = x - (R + g + t/2) n     x centre, g gap, t thickness, n normal
//
// and if it lies on another wall, that one is at least as near.
#pragma once

#include <vector>

#include "granular_adapter/nscd/detection/contact_point.hpp"
#include "granular_adapter/nscd/problem/bodies.hpp"
#include "granular_adapter/nscd/problem/walls.hpp"

namespace turbidite::nscd {

/// Two contact points, by index: the foot of one lies on the wall of the other.
struct CommonEdge {
    std::size_t point = 0;   ///< where laws of a range do not act
    std::size_t nearer = 0;  ///< the other, or the one of the lower wall if both have one foot
};

struct WallContacts {
    const std::vector<ContactPoint>& points;
    const Bodies& bodies;
    const std::vector<Wall>& walls;
    const std::vector<std::uint8_t>& round;  ///< by shape: whether it is a disc or sphere
};

/// Of points within the range of a law [m].
std::vector<CommonEdge> common_edges(const WallContacts& contacts, double range);

}  // namespace turbidite::nscd
