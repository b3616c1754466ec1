// SPDX-License-Identifier: GPL-3.0-or-later
//
// The places of this rank's cells in a box formed by the cells of all ranks, and the axis of each
// coefficient of a matrix on them: what is needed to read the matrix (boxOperator.hpp). A row is
// all cells with the same y. Every function here is called by all ranks, and gives all the same
// verdict.
#pragma once

#include <lduMesh.H>

#include <array>
#include <string>
#include <vector>

#include "fluid_adapter/foam_solver/boxNumbering.hpp"
#include "fluid_adapter/ranks/rank_group.hpp"

namespace turbidite {

struct BoxCells {
    RankGroup ranks;
    std::array<int, 2> cells{};  ///< columns and rows of the box, over all ranks
    std::vector<int> place;      ///< i + nx j, by cell of this rank
    /// By coefficient of the matrix: the axis along which it couples.
    std::vector<unsigned char> axis;
    std::vector<std::vector<int>> beyond;  ///< by patch and face: place of the cell on the far side

    int row(int place) const { return place / cells[0]; }
    int column(int place) const { return place % cells[0]; }
};

/// The ranks that OpenFOAM runs on; a single rank without MPI if it does not run in parallel.
RankGroup openfoam_ranks();

/// With places derived from the faces between cells (boxNumbering.hpp). Throws DoesNotFit.
BoxCells number_cells(const Foam::lduMesh& mesh, const RankGroup& ranks);

/// With given places. Throws DoesNotFit.
BoxCells box_cells(const Foam::lduMesh& mesh, const RankGroup& ranks,
                   const std::array<int, 2>& cells, const std::vector<int>& place);

/// Throws DoesNotFit on every rank if any rank has found a fault, with the text of the first.
void demand(const RankGroup& ranks, const std::string& fault);

}  // namespace turbidite
