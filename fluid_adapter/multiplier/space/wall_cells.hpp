// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The cells of walls inside the box in space: those whose centres are within half the thickness of
// the surface. Where a wall is at least two cells thick no fluid passes between them. They are kept
// as long as the wall stays where it is, as a drum does that turns about its axis. Valid C++17.
#pragma once

#include <unordered_map>
#include <vector>

#include "fluid_adapter/multiplier/immersed_grain.hpp"
#include "fluid_adapter/multiplier/space/cell_owners.hpp"

namespace turbidite {

/// Consecutive cells along x, within the grid.
struct WallRun {
    CellPlace first;
    int count;
    Eigen::Vector3d arm;  ///< from the wall's position to the centre of the first [m]
};

class WallCells {
 public:
    /// Keeps both by reference.
    WallCells(const LayerCells& cells, const CellOwners& owners) : cells_(cells), owners_(owners) {}

    /// Of a wall, in all layers whose owners are known.
    const std::vector<WallRun>& find(const ImmersedGrain& wall);

 private:
    struct Found {
        WallBody body;
        Eigen::Vector3d position;
        std::vector<WallRun> runs;
    };

    std::vector<WallRun> search(const ImmersedGrain& wall) const;
    void search_row(const ImmersedGrain& wall, const CellPlace& first, int last,
                    std::vector<WallRun>& runs) const;
    const CellGrid& grid() const { return *cells_.grid; }

    const LayerCells& cells_;
    const CellOwners& owners_;
    std::unordered_map<GrainId, Found> found_;
};

}  // namespace turbidite
