// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Files of ParaView's series: VTK PolyData with ascii arrays, and the collection (.pvd) that puts
// them on a time axis. Files may be read at any time: no file is ever incomplete.
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "coupler/protocol/records.hpp"

namespace turbidite::vtk {

/// Numbers of points and cells of a PolyData piece.
struct PieceSize {
    std::size_t points = 0;
    std::size_t vertices = 0;
    std::size_t lines = 0;
    std::size_t polygons = 0;
};

/// Writes a file of one piece; `content` writes the inside of <Piece>. Throws Failure when the disk
/// is full; an existing file is then kept.
void write_poly_data(const std::filesystem::path& file, const PieceSize& size,
                     const std::function<void(std::ostream&)>& content);

/// "x y z\n" and "x\n", nine digits.
std::string triple(const Vec3& v);
std::string scalar(double value);

/// One <DataArray>; `head` holds its attributes except the format, `text` formats each entry.
template <class Range, class Text>
void data_array(std::ostream& out, const char* head, const Range& range, Text text) {
    out << "<DataArray " << head << " format=\"ascii\">\n";
    for (const auto& entry : range) out << text(entry);
    out << "</DataArray>\n";
}

/// The same for numbers per entry, vectors per entry, and whole numbers per entry.
template <class Range, class Value>
void scalars(std::ostream& out, const std::string& name, const Range& range, Value value) {
    data_array(out, ("type=\"Float64\" Name=\"" + name + "\"").c_str(), range,
               [&](const auto& entry) { return scalar(value(entry)); });
}
template <class Range, class Value>
void vectors(std::ostream& out, const std::string& name, const Range& range, Value value) {
    data_array(out, ("type=\"Float64\" Name=\"" + name + "\" NumberOfComponents=\"3\"").c_str(),
               range, [&](const auto& entry) { return triple(value(entry)); });
}
template <class Range, class Value>
void integers(std::ostream& out, const std::string& name, const Range& range, Value value) {
    data_array(out, ("type=\"Int64\" Name=\"" + name + "\"").c_str(), range,
               [&](const auto& entry) { return fmt::format("{}\n", value(entry)); });
}

/// The body of <Verts>, <Lines> or <Polys> whose cells use the points in order; `sizes` says how
/// many points each cell has.
void consecutive_cells(std::ostream& out, const std::vector<std::size_t>& sizes);

/// The series file: complete after every call.
class Collection {
 public:
    /// Starts an empty series.
    explicit Collection(std::filesystem::path file);

    /// Goes on with a series after its first `length` bytes (`length`()). Throws Failure if the
    /// file is shorter.
    Collection(std::filesystem::path file, std::int64_t length);

    const std::filesystem::path& file() const { return file_; }

    /// Bytes written so far, without the end tags.
    std::int64_t length();

    /// Adds one time with one or more files (parts), named relative to the series file. Throws
    /// Failure when the disk is full.
    void add(double time, const std::vector<std::string>& parts);

    /// Waits until the disk has the series and all files that it names. Throws Failure.
    void put_on_disk();

 private:
    void write(const std::string& text);

    std::filesystem::path file_;
    std::ofstream out_;
    std::vector<std::string> not_on_disk_;  ///< parts that were added since the last call
};

}  // namespace turbidite::vtk
