// SPDX-License-Identifier: GPL-3.0-or-later
//
// YADE's walls and facets as walls of the engine. Where they are and how they move is read from
// their states before every step; those that move are moved after it, as YADE's integrator would.
#pragma once

#include <string>
#include <vector>

#include "granular_adapter/nscd/problem/walls.hpp"
#include "granular_adapter/yade/yade_bodies.hpp"

namespace turbidite::yade {

/// A wall in the axes of its body: key, material, half length, and place and normal seen from the
/// body's position.
class HostedWalls {
 public:
    HostedWalls() = default;
    /// `states` of the bodies that `walls` belong to, in their order.
    HostedWalls(std::vector<nscd::Wall> walls, BodyStates states)
        : local_(std::move(walls)), states_(std::move(states)) {}

    /// As they are in YADE now.
    std::vector<nscd::Wall> read() const;

    /// Moves those that have a velocity or spin.
    void advance(double dt) const;

 private:
    std::vector<nscd::Wall> local_;
    BodyStates states_;
};

}  // namespace turbidite::yade
