// SPDX-License-Identifier: GPL-3.0-or-later
//
// Column i and row j of every cell of a mesh, found from which cells share a face, for any
// numbering of the cells: a corner is a cell with two neighbours, the first row follows the
// boundary from there, and every further row is what lies across the one before. The corner and the
// way are the ones with the smallest cell numbers, so that x is blockMesh's x. Faces that cyclic
// patches close are not part of it.
#pragma once

#include <array>
#include <stdexcept>
#include <vector>

namespace turbidite {

/// Says what of the mesh or of the matrix does not fit.
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
    std::vector<int> place;      ///< of each cell: i + nx j

    int row(int cell) const { return place[cell] / cells[0]; }
    int column(int cell) const { return place[cell] % cells[0]; }
};

/// Throws DoesNotFit unless the cells form one box of 3 x 3 cells or more.
BoxNumbering number_box(const CellFaces& faces);

}  // namespace turbidite
