// SPDX-License-Identifier: GPL-3.0-or-later
#include "granular_adapter/yade/hosted_walls.hpp"

#include "coupler/rigid/vec3.hpp"
#include "granular_adapter/yade/bodies/turn.hpp"

namespace turbidite::yade {

std::vector<nscd::Wall> HostedWalls::read(int dimension) const {
    std::vector<nscd::Wall> walls = local_;
    for (std::size_t i = 0; i < walls.size(); ++i) {
        const BodyMotion motion = states_.read(i);
        nscd::Wall& wall = walls[i];
        if (dimension == 3) {  // half-spaces, which keep their axis
            wall.pivot = motion.position;
            wall.point = wall.pivot + local_[i].point;
            wall.twist = motion.twist;
            continue;
        }
        wall.pivot = {motion.position[0], motion.position[1], 0.0};
        // The stored point and normal are in the axes of the body: both turn with it.
        wall.point = wall.pivot + turned_in_plane(motion.orientation, local_[i].point);
        wall.normal = turned_in_plane(motion.orientation, local_[i].normal);
        wall.twist = in_plane(motion.twist);
    }
    return walls;
}

void HostedWalls::advance(double dt) const {
    for (std::size_t i = 0; i < local_.size(); ++i) {
        BodyMotion motion = states_.read(i);
        if (motion.twist.at_rest()) continue;
        const Shift shift = dt * motion.twist;
        motion.position = motion.position + shift.displacement;
        motion.orientation = rotated(motion.orientation, shift.angle);
        states_.write(i, motion);
    }
}

}  // namespace turbidite::yade
