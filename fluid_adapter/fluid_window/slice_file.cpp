// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/fluid_window/slice_file.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <tuple>

#include "coupler/protocol/files/whole_file.hpp"

namespace turbidite {
namespace {

constexpr const char* extension = ".vtr";

/// Appended data: a length in bytes before every array.
void append(std::ostream& out, const std::vector<float>& values) {
    const std::uint64_t bytes = values.size() * sizeof(float);
    out.write(reinterpret_cast<const char*>(&bytes), sizeof bytes);
    out.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(bytes));
}

/// Declares arrays and counts where their data begin, after the header.
class Declaration {
 public:
    std::string of(const std::string& name, int components, std::size_t count) {
        std::ostringstream text;
        text << "<DataArray type=\"Float32\" Name=\"" << name << "\" NumberOfComponents=\""
             << components << "\" format=\"appended\" offset=\"" << offset_ << "\"/>\n";
        offset_ += sizeof(std::uint64_t) + count * sizeof(float);
        return text.str();
    }

    std::size_t offset() const { return offset_; }

 private:
    std::size_t offset_ = 0;
};

/// An edge more than cells, or a single place.
std::size_t cells_along(const std::vector<double>& edges) {
    return std::max<std::size_t>(1, edges.size() - 1);
}

std::string extent_of(const SliceEdges& edges) {
    std::string text;
    for (const std::vector<double>& along : edges)
        text += (text.empty() ? "0 " : " 0 ") + std::to_string(along.size() - 1);
    return text;
}

/// Number of windows in a name; -1 for other files.
std::int64_t windows_of(const std::string& file, const std::string& name) {
    const std::size_t digits = 8, length = name.size() + 1 + digits;
    if (file.compare(0, name.size() + 1, name + "_") != 0) return -1;
    if (file.size() != length + std::string(extension).size()) return -1;
    return std::strtoll(file.c_str() + name.size() + 1, nullptr, 10);
}

}  // namespace

SliceLayout slice_layout(const SliceEdges& edges, const std::vector<SliceArray>& arrays) {
    SliceLayout layout;
    const std::size_t cells = cells_along(edges[0]) * cells_along(edges[1]) * cells_along(edges[2]);
    Declaration declaration;
    const std::string extent = extent_of(edges);
    std::ostringstream out;
    out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"RectilinearGrid\" version=\"1.0\" "
           "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<RectilinearGrid "
           "WholeExtent=\""
        << extent << "\">\n<Piece Extent=\"" << extent << "\">\n<Coordinates>\n";
    const char* const axes[] = {"x", "y", "z"};
    for (int axis = 0; axis < 3; ++axis) out << declaration.of(axes[axis], 1, edges[axis].size());
    out << "</Coordinates>\n<CellData Scalars=\"p\" Vectors=\"U\">\n";
    for (const SliceArray& array : arrays) {
        // Offsets count from the "_" that ends the header, which is not complete yet.
        layout.places.push_back(declaration.offset());
        layout.lengths.push_back(cells * array.components * sizeof(float));
        out << declaration.of(array.name, array.components, cells * array.components);
    }
    out << "</CellData>\n</Piece>\n</RectilinearGrid>\n<AppendedData encoding=\"raw\">\n_";
    const std::size_t header = out.str().size();
    for (std::size_t& place : layout.places) place += header;
    for (const std::vector<double>& along : edges)
        append(out, std::vector<float>(along.begin(), along.end()));
    layout.begin = out.str();
    layout.end = "\n</AppendedData>\n</VTKFile>\n";
    return layout;
}

void write_slice(const std::filesystem::path& file, const SliceEdges& edges,
                 const std::vector<SliceArray>& arrays) {
    const SliceLayout layout = slice_layout(edges, arrays);
    write_whole(file, [&](std::ostream& out) {
        out << layout.begin;
        for (const SliceArray& array : arrays) append(out, array.values);
        out << layout.end;
    });
}

std::string slice_file_name(const std::string& name, std::int64_t windows) {
    char number[32];
    std::snprintf(number, sizeof number, "_%08lld", static_cast<long long>(windows));
    return name + number + extension;
}

void write_slice_series(const std::filesystem::path& series, const std::vector<std::string>& names,
                        double step) {
    std::vector<std::tuple<std::int64_t, std::size_t, std::string>> found;  // window, part, file
    for (const auto& entry : std::filesystem::directory_iterator(series.parent_path()))
        for (std::size_t part = 0; part < names.size(); ++part) {
            const std::string file = entry.path().filename().string();
            const std::int64_t windows = windows_of(file, names[part]);
            if (windows >= 0) found.emplace_back(windows, part, file);
        }
    std::sort(found.begin(), found.end());
    write_whole(series, [&](std::ostream& out) {
        out.precision(9);
        out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" "
               "version=\"0.1\">\n<Collection>\n";
        for (const auto& [windows, part, file] : found)
            out << "<DataSet timestep=\"" << static_cast<double>(windows) * step << "\" part=\""
                << part << "\" file=\"" << file << "\"/>\n";
        out << "</Collection>\n</VTKFile>\n";
    });
}

}  // namespace turbidite
