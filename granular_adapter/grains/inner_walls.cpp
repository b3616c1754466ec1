// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/grains/inner_walls.hpp"

#include "coupler/protocol/scene/plates.hpp"
#include "coupler/rigid/vec3.hpp"
#include "coupler/shapes/wall_surface.hpp"

namespace turbidite {
namespace {

nscd::Wall wall_of(const Plate& plate) {
    const Vec3 along = plate.to - plate.from;
    const double length = norm(along);
    nscd::Wall wall;
    wall.point = plate.from + 0.5 * along;
    // n = e_z x t. Grains may be on both sides, so its sense does not matter.
    wall.normal = {-along[1] / length, along[0] / length, 0.0};
    wall.half_length = 0.5 * length;
    wall.twist = plate.motion->rate(0.0, 1.0);  // of those that follow a motion: set later
    wall.pivot = plate.pivot;
    wall.friction = plate.friction;
    wall.half_thickness = 0.5 * plate.thickness;
    wall.key = plate.key;
    return wall;
}

/// Form and place of a wall in space.
nscd::Wall surface_as_wall(const WallSurface& from) {
    nscd::Wall wall;
    wall.form = from.round ? nscd::WallForm::round : nscd::WallForm::rectangle;
    wall.point = from.point;
    wall.normal = from.normal;
    if (from.round) {
        wall.meridian = from.meridian;
        return wall;
    }
    wall.side = from.side;
    wall.half_length = from.half_length;
    wall.half_width = from.half_width;
    return wall;
}

nscd::Wall wall_of(const SpaceWall& from) {
    nscd::Wall wall = surface_as_wall(surface_of(from));
    wall.twist = from.motion->rate(0.0, 1.0);  // of those that follow a motion: set later
    wall.pivot = from.pivot;
    wall.friction = from.friction;
    wall.material = from.material;
    wall.half_thickness = 0.5 * from.thickness;
    wall.key = from.key;
    return wall;
}

}  // namespace

std::vector<nscd::Wall> inner_walls(const Settings& settings) {
    std::vector<nscd::Wall> walls;
    if (dimension_of(settings) == 3) {
        for (const SpaceWall& wall : space_walls_of(settings)) walls.push_back(wall_of(wall));
        return walls;
    }
    for (const Plate& plate : plates_of(settings)) walls.push_back(wall_of(plate));
    return walls;
}

}  // namespace turbidite
