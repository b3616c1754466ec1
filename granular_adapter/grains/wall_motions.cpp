// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/grains/wall_motions.hpp"

namespace turbidite {

void set_velocities(std::vector<nscd::Wall>& walls, const std::vector<MovedWall>& moved,
                    double time, double step) {
    for (nscd::Wall& wall : walls)
        for (const MovedWall& entry : moved) {
            if (entry.wall != wall.key) continue;
            const WallShift rate = entry.motion->rate(time, step);
            wall.velocity = rate.displacement;
            wall.spin = rate.angle;
        }
}

void follow_walls(std::vector<Border>& borders, const std::vector<nscd::Wall>& walls) {
    for (Border& border : borders)
        for (const nscd::Wall& wall : walls)
            if (wall.key == border.plane.key) border.plane = wall;
}

}  // namespace turbidite
