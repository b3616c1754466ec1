// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Local indices of the cells of a rank: one number for each cell of a rectangular block of the grid
// that encloses them. Beyond a cyclic side the block continues with the cells of the opposite side.
// Valid C++17.
#pragma once

#include <array>
#include <cstddef>

namespace turbidite {

struct CellTable {
    /// Local index by place in the block, x fastest; -1 unknown.
    const int* index = nullptr;
    std::array<int, 2> first{}, width{};  ///< of the block: its first cell and its cells per axis
    std::array<int, 2> turn{};            ///< cells around a cyclic axis, 0 for other axes

    /// Local index of a cell of the grid; -1 if this rank does not know the cell.
    int at(int i, int j) const {
        const int x = along(0, i), y = along(1, j);
        return x < 0 || y < 0 ? -1 : index[x + static_cast<std::size_t>(width[0]) * y];
    }

    /// Offset within the block along an axis; -1 outside.
    int along(int axis, int i) const {
        int place = i - first[axis];
        if (place < 0) place += turn[axis];
        return place >= 0 && place < width[axis] ? place : -1;
    }
};

}  // namespace turbidite
