// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/grains/inner_walls.hpp"

#include "coupler/protocol/scene/plates.hpp"
#include "coupler/protocol/scene/space_walls.hpp"
#include "coupler/rigid/vec3.hpp"

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

Vec3 unit(const Vec3& x) {
    return (1.0 / norm(x)) * x;
}

/// Form and place of a wall in space.
nscd::Wall surface_of(const SpaceWall& from) {
    nscd::Wall wall;
    if (from.kind == SpaceWallKind::plate) {
        wall.form = nscd::WallForm::rectangle;
        wall.point = from.place + 0.5 * (from.a + from.b);
        wall.side = unit(from.a);
        wall.normal = unit(cross(from.a, from.b));
        wall.half_length = 0.5 * norm(from.a);
        wall.half_width = 0.5 * norm(from.b);
        return wall;
    }
    wall.form = nscd::WallForm::round;
    wall.point = from.place;
    wall.normal = unit(from.a);
    const double height = from.kind == SpaceWallKind::ring ? 0.0 : norm(from.a);
    const double end = from.kind == SpaceWallKind::cylinder ? from.radius : from.radius2;
    // Two ends (radius, height): a cylinder has the same radius at both, a cone another one, and a
    // ring two radii at the same height.
    wall.meridian = {{{from.radius, 0.0}, {end, height}}};
    return wall;
}

nscd::Wall wall_of(const SpaceWall& from) {
    nscd::Wall wall = surface_of(from);
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
