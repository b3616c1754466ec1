// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Where the host of an MD adapter begins. Its positions are behind those of the protocol,
//
//     x = q - lead U        lead = (dt - s)/2, see md_adapter.hpp
//
// and what parts from a neighbour or a wall at q may be in it at x: its springs would begin loaded,
// with energy that the grain never had. Such grains begin at q.
#pragma once

#include <cstdint>
#include <vector>

#include "coupler/protocol/run_values.hpp"
#include "coupler/protocol/settings.hpp"
#include "granular_adapter/nscd/problem/bodies.hpp"
#include "granular_adapter/nscd/problem/walls.hpp"

namespace turbidite {

/// Moves bodies from q to where the host begins; `lead` in seconds. Non-zero entries of the result
/// are those that stay at q. Bodies of other ranks are not seen.
std::vector<std::uint8_t> take_first_positions(nscd::Bodies& bodies, double lead,
                                               const RunValues& run, const ShapeTable& shapes,
                                               const std::vector<nscd::Wall>& walls);

/// Takes position and orientation of bodies whose entry is not zero from the same bodies elsewhere.
void put_where(const std::vector<std::uint8_t>& mask, const nscd::Bodies& from, nscd::Bodies& to);

/// [m]
double deepest_overlap(const nscd::Bodies& bodies, const RunValues& run, const ShapeTable& shapes,
                       const std::vector<nscd::Wall>& walls);

}  // namespace turbidite
