// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Pairs of grains, and grains at walls, that may touch before anything has moved by half the skin:
//
//     listed     circumscribed circles closer than the skin, when the list was made
//     complete   while no grain has moved by more than half the skin since
//
// The order depends on the ids alone and not on when the list was made, so that forces are summed
// in the same order in a run that goes on from a saved state.
#pragma once

#include <vector>

#include "granular_adapter/nscd/problem/bodies.hpp"
#include "granular_adapter/nscd/problem/periodic_box.hpp"
#include "granular_adapter/nscd/problem/walls.hpp"
#include "granular_adapter/nscd/problem/warm_start.hpp"

namespace turbidite::soft {

/// Two bodies, a with the smaller id, or a body b and a wall; the other index is -1.
struct Near {
    nscd::ContactKey name;  ///< of feature 0
    std::int32_t a, b, wall;
};

class Neighbours {
 public:
    /// `skin` [m]
    Neighbours(const nscd::PeriodicBox& box, double skin) : box_(box), skin_(skin) {}

    /// A list that is complete for the present positions, in ascending order of names.
    const std::vector<Near>& of(const nscd::Bodies& bodies, const std::vector<nscd::Wall>& walls);

    /// To be called when bodies were removed or exchanged.
    void forget() { places_.clear(), near_.clear(); }

 private:
    bool complete(const std::vector<Vec3>& positions) const;
    void search(const nscd::Bodies& bodies, const std::vector<nscd::Wall>& walls);

    nscd::PeriodicBox box_;
    double skin_;
    std::vector<Vec3> places_;  ///< of the bodies when the list was made
    std::vector<Near> near_;
};

}  // namespace turbidite::soft
