// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bodies that lie in each other before the first step. The engine takes overlap back slowly; much
// of it is a mistake of the packing.
#pragma once

#include <optional>

#include "coupler/protocol/records.hpp"
#include "granular_adapter/nscd/problem/bodies.hpp"
#include "granular_adapter/nscd/problem/periodic_box.hpp"

namespace turbidite::yade {

struct Overlap {
    GrainId first = 0;
    GrainId second = 0;
    double depth = 0.0;  ///< least displacement that parts them [m]
    double share = 0.0;  ///< of the smaller circumscribed radius
};

/// The pair with the largest share; none when no two overlap. Pairs of fixed bodies do not count.
std::optional<Overlap> largest_overlap(const nscd::Bodies& bodies, const ShapeTable& shapes,
                                       const nscd::PeriodicBox& box);

}  // namespace turbidite::yade
