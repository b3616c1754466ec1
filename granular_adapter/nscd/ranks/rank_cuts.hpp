// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Which rank has which cell: space is cut by planes, again and again, so that both sides of a cut
// have work in proportion to their ranks. No result depends on it.
#pragma once

#include <vector>

#include "coupler/rigid/vec3.hpp"

namespace turbidite::nscd {

/// The work of a cell, in any unit.
struct CellLoad {
    Vec3 centre{};
    double work = 0.0;
};

class RankCuts {
 public:
    /// One rank has everything.
    RankCuts() = default;
    /// The order of the loads does not matter.
    RankCuts(std::vector<CellLoad> loads, int ranks);

    int rank(const Vec3& x) const;

 private:
    struct Cut {
        int axis = -1;  ///< -1: all on one rank
        double at = 0.0;
        int rank = 0;
        std::size_t below = 0, above = 0;  ///< cuts
    };

    std::size_t add(std::vector<CellLoad> loads, int first, int ranks);

    std::vector<Cut> cuts_{Cut{}};
};

}  // namespace turbidite::nscd
