// SPDX-License-Identifier: GPL-3.0-or-later
//
// Column i and row j of every cell of a mesh, from the information which cells share a face, for
// any numbering of the cells. A corner is a cell with two neighbours. The first row follows the
// boundary from a corner, and every further row consists of the neighbours of the row before. The
// corner and the direction are those with the smallest cell numbers, so that x is blockMesh's x.
// Faces of cyclic patches are not included.
#pragma once

#include <array>
#include <stdexcept>
#include <vector>

namespace turbidite {

/// Explains what in the mesh or the matrix does not fit.
struct DoesNotFit : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The faces between cells 0 .. count - 1: face f lies between cells low[f] and high[f].
struct CellFaces {
    int count = 0;
    std::vector<int> low, high;
};

struct BoxNumbering {
    std::array<int, 2> cells{};  ///< columns and rows
    std::vector<int> place;      ///< i + nx j, by cell

    int row(int cell) const { return place[cell] / cells[0]; }
    int column(int cell) const { return place[cell] % cells[0]; }
};

/// Throws DoesNotFit unless the cells form one box of at least 3 x 3 cells.
BoxNumbering number_box(const CellFaces& faces);

}  // namespace turbidite
