// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Cells whose centres the surface of a moving sphere has crossed since the last window: those that
// it has newly covered, and those that it has left to the fluid. Valid C++17.
#pragma once

#include <vector>

#include "fluid_adapter/multiplier/immersed_grain.hpp"
#include "fluid_adapter/multiplier/space/cell_owners.hpp"

namespace turbidite {

struct CrossedCell {
    int grain;
    CellPlace at;         ///< in the grid
    Eigen::Vector3d arm;  ///< r = x - X of its centre [m]
    bool covered;         ///< or else left
};

class CrossedCells {
 public:
    /// Keeps references to both; the owners are those of the window's positions.
    CrossedCells(const LayerCells& cells, const CellOwners& owners)
        : cells_(cells), owners_(owners) {}

    /// Of this rank's layers and of those beside them, sphere by sphere in the order of their ids.
    /// A cell that another body has now is left by nobody; one between two spheres whose surfaces
    /// overlap may be left by both.
    const std::vector<CrossedCell>& find(const std::vector<ImmersedGrain>& grains);

    /// Those of the last `find` that may cross cells, in the order of their ids: what two of them
    /// give to a cell adds up to the same digits in whatever order grains are sent. Not in a box
    /// that is shorter along a cyclic axis than a sphere and two cells on either side of it.
    const std::vector<std::size_t>& crossing() const { return crossing_; }

 private:
    /// A row of cells along x, relative to the sphere: r = (x, y, z) for the cells of any x.
    struct Row {
        int grain, j, k;  // in the grid
        double y, z;
    };

    void find_rows(int grain, const ImmersedGrain& sphere);
    void find_row(const Row& row, const ImmersedGrain& sphere);
    void take(const Row& row, const ImmersedGrain& sphere, int i);
    bool crosses(const ImmersedGrain& body) const;
    void find_crossing(const std::vector<ImmersedGrain>& grains);
    bool known(int layer) const;
    const CellGrid& grid() const { return *cells_.grid; }

    LayerCells cells_;
    const CellOwners& owners_;
    std::vector<std::size_t> crossing_;
    std::vector<CrossedCell> crossed_;
};

/// Calls visit(j, k, y, z) for the rows of cells along x within `reach` of a position, but for what
/// is beyond sides: their place in the grid, and their distances from the position [m].
template <class Visit>
void for_rows_within(const CellGrid& grid, const Eigen::Vector3d& at, double reach, Visit visit) {
    const LayerSpan up = grid.layers_within(1, at.y(), reach),
                    across = grid.layers_within(2, at.z(), reach);
    for (int j = up.low; j <= up.high; ++j) {
        const int layer = grid.wrapped(1, j);
        if (layer < 0) continue;
        for (int k = across.low; k <= across.high; ++k)
            if (const int row = grid.wrapped(2, k); row >= 0)
                visit(layer, row, grid.centre(1, j) - at.y(), grid.centre(2, k) - at.z());
    }
}

/// Whether a sphere covered r = x - X before the window.
inline bool was_inside(const ImmersedGrain& sphere, const Eigen::Vector3d& arm) {
    return (arm + sphere.moved).squaredNorm() < sphere.radius * sphere.radius;
}

}  // namespace turbidite
