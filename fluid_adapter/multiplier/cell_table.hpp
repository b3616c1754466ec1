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
    const int* index = nullptr;           ///< of the block's cells, row by row; -1 unknown
    std::array<int, 2> first{}, width{};  ///< of the block
    std::array<int, 2> turn{};            ///< cells around a cyclic axis, 0 for others
    /// Rows of the block whose cells have the numbers 0, 1, ... from row to row: no table is read.
    int first_counted = 0, counted_rows = 0;

    /// Local index of a cell of the grid; -1 if this rank does not know the cell.
    int at(int i, int j) const {
        const int x = along(0, i), y = along(1, j);
        if (x < 0 || y < 0) return -1;
        const int row = y - first_counted;
        if (row >= 0 && row < counted_rows) return x + width[0] * row;
        return index[x + static_cast<std::size_t>(width[0]) * y];
    }

    /// Offset within the block along an axis; -1 outside.
    int along(int axis, int i) const {
        int place = i - first[axis];
        if (place < 0) place += turn[axis];
        return place >= 0 && place < width[axis] ? place : -1;
    }
};

}  // namespace turbidite
