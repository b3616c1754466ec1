// SPDX-License-Identifier: GPL-3.0-or-later
//
// YADE's walls and facets as walls of the engine. Their positions and velocities are read from
// their states before every step; moving walls are advanced after it, as YADE's integrator would
// do.
#pragma once

#include <string>
#include <vector>

#include "granular_adapter/nscd/problem/walls.hpp"
#include "granular_adapter/yade/bodies/yade_bodies.hpp"

namespace turbidite::yade {

/// A wall in the axes of its body: key, material, half length, and position and normal relative to
/// the body's position.
class HostedWalls {
 public:
    HostedWalls() = default;
    /// `states`: those of the bodies of `walls`, in the same order.
    HostedWalls(std::vector<nscd::Wall> walls, BodyStates states)
        : local_(std::move(walls)), states_(std::move(states)) {}

    /// The walls at their present positions in YADE.
    std::vector<nscd::Wall> read(int dimension) const;

    /// Moves the walls that have a velocity or spin, over dt [s].
    void advance(double dt) const;

 private:
    std::vector<nscd::Wall> local_;
    BodyStates states_;
};

}  // namespace turbidite::yade
