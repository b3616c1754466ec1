// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the cells of this rank lie in a box of all ranks' cells, and along which axis each
// coefficient of a matrix on them points: what is needed to read the matrix (boxOperator.hpp).
// Every function here is called by all ranks, and all come to the same verdict.
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
    std::array<int, 2> cells{};            ///< columns and rows, of all ranks
    std::vector<int> place;                ///< of each cell of this rank: i + nx j
    std::vector<unsigned char> axis;       ///< that each coefficient of the matrix lies along
    std::vector<std::vector<int>> beyond;  ///< by patch and face: place of the cell on the far side

    int row(int place) const { return place / cells[0]; }
    int column(int place) const { return place % cells[0]; }
};

/// The ranks that OpenFOAM runs on; one, without MPI, where it does not run in parallel.
RankGroup openfoam_ranks();

/// With the places found from the faces between cells (boxNumbering.hpp). Throws DoesNotFit.
BoxCells number_cells(const Foam::lduMesh& mesh, const RankGroup& ranks);

/// With places that are known.
BoxCells box_cells(const Foam::lduMesh& mesh, const RankGroup& ranks,
                   const std::array<int, 2>& cells, const std::vector<int>& place);

/// Throws DoesNotFit on every rank when one of them has found a fault; with the first one's text.
void demand(const RankGroup& ranks, const std::string& fault);

}  // namespace turbidite
