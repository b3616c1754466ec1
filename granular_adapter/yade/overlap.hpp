// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bodies that overlap before the first step. The engine removes overlap slowly; a large one is an
// error in the packing.
#pragma once

#include <optional>
#include <vector>

#include "coupler/protocol/records.hpp"
#include "granular_adapter/nscd/problem/bodies.hpp"
#include "granular_adapter/nscd/problem/periodic_box.hpp"
#include "granular_adapter/nscd/problem/walls.hpp"

namespace turbidite::yade {

struct Overlap {
    GrainId first = 0;
    GrainId second = 0;
    double depth = 0.0;  ///< smallest displacement that separates them [m]
    double share = 0.0;  ///< depth over the smaller circumscribed radius
    bool wall = false;   ///< `first` is the key of a wall
};

/// The pair with the largest relative depth; none if nothing overlaps. Pairs of fixed bodies, and
/// fixed bodies in walls, are ignored.
std::optional<Overlap> largest_overlap(const nscd::Bodies& bodies, const ShapeTable& shapes,
                                       const std::vector<nscd::Wall>& walls,
                                       const nscd::PeriodicBox& box);

}  // namespace turbidite::yade
