// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Local indices of a rank's cells, one number for each cell of a block of the grid around them. A
// cyclic side has the other end's cells beyond it. Valid C++17.
#pragma once

#include <array>
#include <cstddef>

namespace turbidite {

struct CellTable {
    const int* index = nullptr;           ///< of the block's cells, row by row; -1 unknown
    std::array<int, 2> first{}, width{};  ///< of the block
    std::array<int, 2> turn{};            ///< cells around a cyclic axis, 0 for others

    /// Local index of a cell of the grid, -1 where this rank knows nothing of it.
    int at(int i, int j) const {
        const int x = along(0, i), y = along(1, j);
        return x < 0 || y < 0 ? -1 : index[x + static_cast<std::size_t>(width[0]) * y];
    }

    /// Place in the block, -1 outside.
    int along(int axis, int i) const {
        int place = i - first[axis];
        if (place < 0) place += turn[axis];
        return place >= 0 && place < width[axis] ? place : -1;
    }
};

}  // namespace turbidite
