// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/output/vtk_files.hpp"

#include <string_view>
#include <utility>

#include "coupler/output/output_state.hpp"
#include "coupler/protocol/failure.hpp"
#include "coupler/protocol/files/stored_file.hpp"
#include "coupler/protocol/files/whole_file.hpp"

namespace turbidite::vtk {
namespace {

Failure full_disk(const std::filesystem::path& file) {
    return Failure(ExitCode::participant_failed,
                   "cannot write " + file.string() + ": is the disk full?");
}

}  // namespace

void write_poly_data(const std::filesystem::path& file, const PieceSize& size,
                     const std::function<void(std::ostream&)>& content) {
    write_whole(file, [&](std::ostream& out) {
        out << "<?xml version=\"1.0\"?>\n"
               "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
               "<PolyData>\n"
            << fmt::format(
                   "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" "
                   "NumberOfPolys=\"{}\">\n",
                   size.points, size.vertices, size.lines, size.polygons);
        content(out);
        out << "</Piece>\n</PolyData>\n</VTKFile>\n";
    });
}

std::string triple(const Vec3& v) {
    return fmt::format("{:.9g} {:.9g} {:.9g}\n", v[0], v[1], v[2]);
}

std::string scalar(double value) {
    return fmt::format("{:.9g}\n", value);
}

void consecutive_cells(std::ostream& out, const std::vector<std::size_t>& sizes) {
    std::size_t point = 0, end = 0;
    data_array(out, "type=\"Int64\" Name=\"connectivity\"", sizes, [&](std::size_t size) {
        std::string text;
        for (std::size_t k = 0; k < size; ++k) text += fmt::format("{} ", point++);
        text.back() = '\n';
        return text;
    });
    data_array(out, "type=\"Int64\" Name=\"offsets\"", sizes,
               [&](std::size_t size) { return fmt::format("{}\n", end += size); });
}

Collection::Collection(std::filesystem::path file) : file_(std::move(file)) {
    out_.open(file_, std::ios::out | std::ios::trunc);
    out_ << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" "
            "version=\"0.1\">\n<Collection>\n";
}

Collection::Collection(std::filesystem::path file, std::int64_t length) : file_(std::move(file)) {
    cut_to(file_, length);
    out_.open(file_, std::ios::in | std::ios::out | std::ios::ate);
    // Puts the end tags behind the last entry that stays.
    write("");
}

std::int64_t Collection::length() {
    out_.flush();
    return out_.tellp();
}

void Collection::add(double time, const std::vector<std::string>& parts) {
    std::string text;
    for (std::size_t part = 0; part < parts.size(); ++part)
        text += fmt::format("<DataSet timestep=\"{:.9g}\" part=\"{}\" file=\"{}\"/>\n", time, part,
                            parts[part]);
    write(text);
    not_on_disk_.insert(not_on_disk_.end(), parts.begin(), parts.end());
}

void Collection::put_on_disk() {
    const std::filesystem::path folder = file_.parent_path();
    for (const std::string& part : not_on_disk_)
        // One that somebody has removed since is not waited for.
        if (std::filesystem::exists(folder / part)) turbidite::put_on_disk(folder / part);
    if (!not_on_disk_.empty()) turbidite::put_on_disk(folder);  // their names
    not_on_disk_.clear();
    turbidite::put_on_disk(file_);
}

// The next entry and its end tags overwrite the present end tags in one write.
void Collection::write(const std::string& text) {
    constexpr std::string_view end_tags = "</Collection>\n</VTKFile>\n";
    out_ << text << end_tags << std::flush;
    if (!out_) throw full_disk(file_);
    out_.seekp(-static_cast<std::streamoff>(end_tags.size()), std::ios::end);
}

}  // namespace turbidite::vtk
