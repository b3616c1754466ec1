// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Rims that round walls have in common, as where a silo's cylinder meets its hopper. A sphere
// touches the joined surface where its distance from it has a local minimum, so at a common rim it
// does only if it comes no nearer along any of the meridians that start there:
//
//     o . t_i <= 0   for all i,   o rim to centre, t_i along meridian i from the rim
//
// Then all these walls have the point, and the first of them keeps it. Otherwise the point is none:
// it would stop a sphere that rolls over a joint. Only walls of one thickness are joined: where it
// changes, the surface has a step, and each wall keeps its own point at the rim.
#pragma once

#include <array>
#include <vector>

#include "granular_adapter/nscd/problem/walls.hpp"

namespace turbidite::nscd {

/// Other walls at an end of a meridian.
struct Rim {
    std::vector<BesideAxis> others;  ///< their meridians from the rim on, in the wall's own axes
    bool first = true;               ///< no wall of a lower index has this rim
};

/// Of all round walls, wherever they are now. Rims that coincide are joined if their walls have the
/// same thickness, however these move.
class WallJoints {
 public:
    WallJoints() = default;
    explicit WallJoints(const std::vector<Wall>& walls);

    /// Whether a sphere beside the axis of a wall may touch its rim `end`, which is the nearest
    /// place of this wall. `offset`: from the rim to the centre.
    bool is_nearest(std::int32_t wall, std::size_t end, const BesideAxis& offset) const;

 private:
    void join_pair(const std::vector<Wall>& walls, std::size_t i, std::size_t j);

    std::vector<std::array<Rim, 2>> rims_;  ///< by wall; empty without round walls
};

}  // namespace turbidite::nscd
