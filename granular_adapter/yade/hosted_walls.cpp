// SPDX-License-Identifier: GPL-3.0-or-later
#include "granular_adapter/yade/hosted_walls.hpp"

#include "granular_adapter/nscd/engine/theta_scheme.hpp"
#include "granular_adapter/nscd/problem/vec3.hpp"
#include "granular_adapter/yade/turn.hpp"

namespace turbidite::yade {

using nscd::operator+;
using nscd::operator*;

std::vector<nscd::Wall> HostedWalls::read() const {
    std::vector<nscd::Wall> walls = local_;
    for (std::size_t i = 0; i < walls.size(); ++i) {
        const BodyMotion motion = states_.read(i);
        nscd::Wall& wall = walls[i];
        wall.pivot = {motion.position[0], motion.position[1], 0.0};
        wall.point = wall.pivot + turned_in_plane(motion.orientation, local_[i].point);
        wall.normal = turned_in_plane(motion.orientation, local_[i].normal);
        wall.velocity = {motion.velocity[0], motion.velocity[1], 0.0};
        wall.spin = motion.angular_velocity[2];
    }
    return walls;
}

void HostedWalls::advance(double dt) const {
    for (std::size_t i = 0; i < local_.size(); ++i) {
        BodyMotion motion = states_.read(i);
        if (motion.velocity == Vec3{} && motion.angular_velocity == Vec3{}) continue;
        motion.position = motion.position + dt * motion.velocity;
        motion.orientation = nscd::rotated(motion.orientation, dt * motion.angular_velocity);
        states_.write(i, motion);
    }
}

}  // namespace turbidite::yade
