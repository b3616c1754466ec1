// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Files of output.slices for ParaView: VTK RectilinearGrid with cell values as raw float32, and the
// collection (.pvd) that puts them on a time axis.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace turbidite {

/// Edges of the cells along x, y and z [m]; a single one along the axis normal to the slice.
using SliceEdges = std::array<std::vector<double>, 3>;

/// An array by cell, x fastest, then y; a vector's components one after the other.
struct SliceArray {
    std::string name;
    int components = 1;
    std::vector<float> values;
};

/// Throws Failure when the disk is full.
void write_slice(const std::filesystem::path& file, const SliceEdges& edges,
                 const std::vector<SliceArray>& arrays);

/// NAME_00000100.vtr: the slice NAME after so many windows.
std::string slice_file_name(const std::string& name, std::int64_t windows);

/// slices.pvd anew from the files of these slices in the folder, with one part for each name;
/// windows are `step` long [s].
void write_slice_series(const std::filesystem::path& folder, const std::vector<std::string>& names,
                        double step);

}  // namespace turbidite
