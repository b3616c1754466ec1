// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The surfaces of walls inside the box in space (coupler/protocol/scene/space_walls.hpp): a
// rectangle or a surface of revolution, and where it is as the wall moves. Valid C++17.
#pragma once

#include "coupler/protocol/scene/space_walls.hpp"
#include "coupler/shapes/meridian.hpp"

namespace turbidite {

struct WallSurface {
    bool round = false;  ///< the meridian turned about the axis; otherwise a rectangle
    Vec3 point{};        ///< on the axis, where heights begin; the middle of a rectangle [m]
    Vec3 normal{};       ///< the axis, or normal to a rectangle; unit
    Meridian meridian{};
    Vec3 side{};                                 ///< of a rectangle: unit, normal to `normal`
    double half_length = 0.0, half_width = 0.0;  ///< along `side` and along normal x side [m]
};
bool operator==(const WallSurface& a, const WallSurface& b);

/// In the unit of the shape; of a SpaceWall at t = 0.
WallSurface surface_of(const SpaceWallShape& wall);

/// Of a point from the surface, >= 0 [m].
double distance(const WallSurface& surface, const Vec3& point);

/// The smallest box with edges along the axes around something [m].
struct Extent {
    Vec3 low{}, high{};
};

/// Of all that is within `margin` of the surface [m]; of its corners and rims no smaller box.
Extent extent_of(const WallSurface& surface, double margin);

/// A wall at a time, with the mean velocities of the window that begins then.
struct PlacedWall {
    WallSurface surface;
    Vec3 pivot{};   ///< [m]
    Twist twist{};  ///< of the pivot, and about it
};
PlacedWall place(const SpaceWall& wall, double time, double step);

}  // namespace turbidite
