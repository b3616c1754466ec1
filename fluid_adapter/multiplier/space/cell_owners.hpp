// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Which sphere covers a cell of this rank's layers, or of the three beyond either end. Valid C++17.
#pragma once

#include <vector>

#include "fluid_adapter/multiplier/layer_cells.hpp"

namespace turbidite {

/// Indices in the grid.
struct CellPlace {
    int i, j, k;

    CellPlace beside(int axis, int side) const {
        return {i + (axis == 0 ? side : 0), j + (axis == 1 ? side : 0), k + (axis == 2 ? side : 0)};
    }
};

class CellOwners {
 public:
    static constexpr int none = -1;     ///< free, or beyond an open side
    static constexpr int shut_in = -2;  ///< free, with six covered neighbours
    static constexpr int wall = -3;     ///< beyond a wall

    /// Keeps a reference to the grid.
    explicit CellOwners(const LayerCells& cells) : cells_(cells) {}

    void clear();

    /// Whether layer j of the grid is one of those known.
    bool knows(int j) const { return layer(j) >= 0; }

    /// And the layers beside it, or sides.
    bool knows_beside(int j) const;

    /// `count` cells along x; `owner`: a sphere's index, or shut_in. Layers that are not known are
    /// left out.
    void set(const CellPlace& first, int count, int owner);

    /// Of the cells along x; j and k need not be wrapped.
    const int* row(int j, int k) const;

    /// Of a cell in a layer that is known; indices need not be wrapped.
    int operator[](const CellPlace& at) const;

    /// Covered, or beyond a wall.
    bool covered(const CellPlace& at) const {
        const int owner = (*this)[at];
        return owner >= 0 || owner == wall;
    }

 private:
    static constexpr int beyond = 3;

    int layer(int j) const;
    int beyond_side(int axis, int at) const;
    std::size_t number(const CellPlace& at) const;
    const CellGrid& grid() const { return *cells_.grid; }

    LayerCells cells_;
    std::vector<int> owners_;
    std::vector<int> no_owners_, walls_;  // rows beyond sides
};

}  // namespace turbidite
