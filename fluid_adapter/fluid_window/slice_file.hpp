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

/// A file but for the values of its arrays, of which nobody needs to have all.
struct SliceLayout {
    std::string begin;                 ///< text and edges
    std::vector<std::size_t> lengths;  ///< of each array's values [bytes]
    std::vector<std::size_t> places;   ///< where each length is written, before its values
    std::string end;                   ///< after the last values

    std::size_t values(std::size_t array) const { return places[array] + sizeof(std::uint64_t); }
    std::size_t place_of_end() const { return values(places.size() - 1) + lengths.back(); }
};

/// `arrays`: names and components; their values are not read.
SliceLayout slice_layout(const SliceEdges& edges, const std::vector<SliceArray>& arrays);

/// Throws Failure when the disk is full.
void write_slice(const std::filesystem::path& file, const SliceEdges& edges,
                 const std::vector<SliceArray>& arrays);

/// NAME_00000100.vtr: the slice NAME after so many windows.
std::string slice_file_name(const std::string& name, std::int64_t windows);

/// The series (.pvd) anew from the files of these slices in its folder, with one part for each
/// name; windows are `step` long [s].
void write_slice_series(const std::filesystem::path& series, const std::vector<std::string>& names,
                        double step);

}  // namespace turbidite
