// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/grains/inner_walls.hpp"

#include "coupler/protocol/plates.hpp"
#include "coupler/rigid/vec3.hpp"

namespace turbidite {
namespace {

nscd::Wall wall_of(const Plate& plate) {
    const Vec3 along = plate.to - plate.from;
    const double length = norm(along);
    nscd::Wall wall;
    wall.point = plate.from + 0.5 * along;
    wall.normal = {-along[1] / length, along[0] / length, 0.0};
    wall.half_length = 0.5 * length;
    wall.twist = plate.motion->rate(0.0, 1.0);  // of those that follow a motion: set later
    wall.pivot = plate.pivot;
    wall.friction = plate.friction;
    wall.half_thickness = 0.5 * plate.thickness;
    wall.key = plate.key;
    return wall;
}

}  // namespace

std::vector<nscd::Wall> inner_walls(const Settings& settings) {
    std::vector<nscd::Wall> walls;
    for (const Plate& plate : plates_of(settings)) walls.push_back(wall_of(plate));
    return walls;
}

}  // namespace turbidite
