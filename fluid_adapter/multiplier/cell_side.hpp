// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace turbidite {

/// A face of a cell of this rank, seen from the cell.
struct CellSide {
    int cell;  ///< local index
    int axis;
    int side;  ///< -1: towards the origin, +1
};

}  // namespace turbidite
