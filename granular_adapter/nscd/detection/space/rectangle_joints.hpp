// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Edges of rectangles that lie on other rectangles, on half-spaces, or on images of the rectangle
// itself: as with plates of the plane (plane/plate_joints.hpp) a sphere touches such a place only
// if it comes no nearer along the others from there, or it would rebound from the joint that it
// rolls over.
#pragma once

#include <vector>

#include "granular_adapter/nscd/problem/walls.hpp"

namespace turbidite::nscd {

class RectangleJoints {
 public:
    RectangleJoints() = default;
    /// Of all rectangles and half-spaces, wherever they are now.
    explicit RectangleJoints(const std::vector<Wall>& walls);

    /// Whether a sphere may touch a place on the edge of a rectangle, its nearest one of this
    /// rectangle. `offset`: from the place to the centre [m].
    bool is_nearest(std::int32_t wall, const Vec3& place, const Vec3& offset) const;

 private:
    struct Other {
        Wall wall;
        double rounding;  ///< of places on it [m]
    };
    /// By rectangle, what it may end on and that is at least as thick; empty without rectangles.
    std::vector<std::vector<Other>> others_;
};

}  // namespace turbidite::nscd
