// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>

namespace turbidite {

/// A face of a cell of this rank, seen from the cell.
struct CellSide {
    int cell;  ///< local index
    std::int8_t axis;
    std::int8_t side;  ///< -1: towards the origin, +1
    /// Of a film: what is on either side of it moves as prescribed, whatever forces act.
    bool held = false;
};

}  // namespace turbidite
