// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bodies that overlap before the first step. The engine removes overlap slowly; a large one is an
// error in the packing.
#pragma once

#include <optional>

#include "coupler/protocol/records.hpp"
#include "granular_adapter/nscd/problem/bodies.hpp"
#include "granular_adapter/nscd/problem/periodic_box.hpp"

namespace turbidite::yade {

struct Overlap {
    GrainId first = 0;
    GrainId second = 0;
    double depth = 0.0;  ///< smallest displacement that separates them [m]
    double share = 0.0;  ///< depth over the smaller circumscribed radius
};

/// The pair with the largest relative depth; none if no two bodies overlap. Pairs of fixed bodies
/// are ignored.
std::optional<Overlap> largest_overlap(const nscd::Bodies& bodies, const ShapeTable& shapes,
                                       const nscd::PeriodicBox& box);

}  // namespace turbidite::yade
