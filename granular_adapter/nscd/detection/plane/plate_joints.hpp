// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Ends of plates that lie on other plates, on half-planes, or on images of the plate itself: there
// the surface goes on. A body touches it where their distance has a local minimum, so at such an
// end only if it comes no nearer along any of the plates that lead on from there:
//
//     n . d <= 0 for all d     n from the end to the body, d along a plate from the end
//
// Otherwise the point is none: it would stop a polygon that slides over a joint with its front
// side, and a disc would rebound from it. A thicker plate ends with an edge of its own where it
// meets a thinner one, and keeps its point there.
#pragma once

#include <array>
#include <vector>

#include "granular_adapter/nscd/problem/walls.hpp"

namespace turbidite::nscd {

class PlateJoints {
 public:
    PlateJoints() = default;
    /// Of all segments and half-planes, wherever they are now.
    explicit PlateJoints(const std::vector<Wall>& walls);

    /// Whether a body may touch an end of a plate, from which the unit normal leads to it. `end`: 0
    /// for that at -half_length along e_z x n, 1 for the other.
    bool is_nearest(std::int32_t wall, std::size_t end, const Vec3& normal) const;

    /// Whether a plate goes on from an end, straight or upwards on the side of a normal. Below such
    /// a valley a corner may be beyond the ends of both plates.
    bool is_valley(std::int32_t wall, std::size_t end, const Vec3& normal) const;

 private:
    /// By wall and end, the directions of other plates from there, unit; empty if no plates meet.
    std::vector<std::array<std::vector<Vec3>, 2>> onward_;
};

}  // namespace turbidite::nscd
