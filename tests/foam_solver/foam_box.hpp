// SPDX-License-Identifier: GPL-3.0-or-later
//
// A small OpenFOAM case for the stock applications: a box of 3 x 3 blocks, whose cells blockMesh
// numbers block by block, and the boundary conditions at the four sides.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "tests/unit/case/scratch_folder.hpp"

namespace turbidite {

/// Left, right, bottom, top.
using Sides = std::array<std::string, 4>;

struct FoamBox {
    /// Edges of the blocks.
    std::array<double, 4> x = {0.0, 0.5, 1.0, 1.5}, y = {0.0, 0.25, 0.5, 0.75};
    std::array<int, 2> cells = {8, 6};  ///< of a block
    int layers = 1;
    bool hole = false;                                     ///< omit the block in the middle
    Sides patches = {"patch", "patch", "patch", "patch"};  ///< or cyclic
    std::string lower_left;  ///< condition of the lower third of the left side, if it differs
    std::string control;     ///< further entries of controlDict
    std::string ddt = "Euler", solution;  ///< time derivative; entries of fvSolution

    int cell_count() const { return cells[0] * cells[1] * layers * (hole ? 8 : 9); }
};

/// Writes a case with end time `end` and steps of `step`, with output at the end in 16 digits.
void write_box(const ScratchFolder& folder, const FoamBox& box, double step, double end);

/// `values` empty: zero. Conditions are the contents of dictionaries.
void write_field(const ScratchFolder& folder, const FoamBox& box, const std::string& name,
                 const std::string& dimensions, const Sides& conditions,
                 const std::vector<double>& values = {});

void write_vector_field(const ScratchFolder& folder, const FoamBox& box, const std::string& name,
                        const Sides& conditions);

/// `ranks`: their numbers along x and along y.
void write_decomposition(const ScratchFolder& folder, const std::array<int, 2>& ranks);

/// All numbers of the internal field of a file; vectors are concatenated.
std::vector<double> read_field(const std::filesystem::path& file);

}  // namespace turbidite
