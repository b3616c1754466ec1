// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/grains/wall_motions.hpp"

#include <unordered_map>

namespace turbidite {

void set_velocities(std::vector<nscd::Wall>& walls, const std::vector<Moved>& moved, double time,
                    double step) {
    for (nscd::Wall& wall : walls)
        for (const Moved& entry : moved)
            // (d(t + dt) - d(t))/dt: at the end of the window the wall is where its motion
            // prescribes.
            if (entry.what == wall.key) wall.twist = entry.motion->rate(time, step);
}

void set_velocities(nscd::Bodies& bodies, const std::vector<Moved>& moved, double time,
                    double step) {
    if (moved.empty()) return;
    std::unordered_map<std::int64_t, Twist> rates;
    for (const Moved& entry : moved) rates.emplace(entry.what, entry.motion->rate(time, step));
    for (std::size_t i = 0; i < bodies.size(); ++i)
        if (const auto at = rates.find(bodies.id[i]); at != rates.end())
            bodies.twist[i] = at->second;
}

void follow_walls(std::vector<Border>& borders, const std::vector<nscd::Wall>& walls) {
    for (Border& border : borders)
        for (const nscd::Wall& wall : walls)
            if (wall.key == border.plane.key) border.plane = wall;
}

}  // namespace turbidite
