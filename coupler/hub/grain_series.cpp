// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/hub/grain_series.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <fstream>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "coupler/protocol/failure.hpp"

namespace turbidite {
namespace {

std::string triple(const Vec3& v) {
    return fmt::format("{:.9g} {:.9g} {:.9g}\n", v[0], v[1], v[2]);
}

template <class Value>
void data_array(std::ostream& out, const char* head, const std::vector<GrainState>& grains,
                Value value) {
    fmt::print(out, "<DataArray {} format=\"ascii\">\n", head);
    for (const GrainState& grain : grains) out << value(grain);
    out << "</DataArray>\n";
}

// Written beside and renamed: a reader never meets half a file.
template <class Content>
void write_whole(const std::filesystem::path& file, Content content) {
    const std::filesystem::path part = file.string() + ".part";
    {
        std::ofstream out(part);
        content(out);
        out.flush();
        if (!out)
            throw Failure(ExitCode::participant_failed,
                          "cannot write " + file.string() + ": is the disk full?");
    }
    std::filesystem::rename(part, file);
}

Vec3 divided(const Vec3& v, double by) {
    return {v[0] / by, v[1] / by, v[2] / by};
}

}  // namespace

GrainSeries::GrainSeries(std::filesystem::path folder) : folder_(std::move(folder)) {
    std::filesystem::create_directories(folder_);
    collection_.open(folder_ / "grains.pvd", std::ios::out | std::ios::trunc);
    collection_
        << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
}

void GrainSeries::write(double time, std::int64_t step, double window, const Motion& state,
                        const std::vector<Kick>& kicks) {
    std::unordered_map<GrainId, Vec3> forces;
    for (const Kick& kick : kicks) forces[kick.id] = kick.force;
    const auto force = [&](const GrainState& g) {
        const auto at = forces.find(g.id);
        return triple(at == forces.end() ? Vec3{} : at->second);
    };
    const auto& grains = state.grains;
    const std::string name = fmt::format("grains_{:08d}.vtp", step);
    write_whole(folder_ / name, [&](std::ostream& out) {
        fmt::print(out,
                   "<?xml version=\"1.0\"?>\n"
                   "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
                   "<PolyData>\n<Piece NumberOfPoints=\"{0}\" NumberOfVerts=\"{0}\">\n<Points>\n",
                   grains.size());
        data_array(out, "type=\"Float64\" NumberOfComponents=\"3\"", grains,
                   [](const GrainState& g) { return triple(g.position); });
        out << "</Points>\n<Verts>\n";
        std::size_t vertex = 0, offset = 0;
        data_array(out, "type=\"Int64\" Name=\"connectivity\"", grains,
                   [&](const GrainState&) { return fmt::format("{}\n", vertex++); });
        data_array(out, "type=\"Int64\" Name=\"offsets\"", grains,
                   [&](const GrainState&) { return fmt::format("{}\n", ++offset); });
        out << "</Verts>\n<PointData Scalars=\"radius\" Vectors=\"velocity\">\n";
        data_array(out, "type=\"Int64\" Name=\"id\"", grains,
                   [](const GrainState& g) { return fmt::format("{}\n", g.id); });
        data_array(out, "type=\"Float64\" Name=\"radius\"", grains,
                   [](const GrainState& g) { return fmt::format("{:.9g}\n", g.radius); });
        data_array(out, "type=\"Float64\" Name=\"density\"", grains,
                   [](const GrainState& g) { return fmt::format("{:.9g}\n", g.density); });
        data_array(out, "type=\"Float64\" Name=\"velocity\" NumberOfComponents=\"3\"", grains,
                   [](const GrainState& g) { return triple(g.velocity); });
        data_array(out, "type=\"Float64\" Name=\"angular_velocity\" NumberOfComponents=\"3\"",
                   grains, [](const GrainState& g) { return triple(g.angular_velocity); });
        data_array(out, "type=\"Float64\" Name=\"force\" NumberOfComponents=\"3\"", grains, force);
        data_array(out, "type=\"Float64\" Name=\"contact_force\" NumberOfComponents=\"3\"", grains,
                   [&](const GrainState& g) { return triple(divided(g.contact_impulse, window)); });
        out << "</PointData>\n</Piece>\n</PolyData>\n</VTKFile>\n";
    });
    add_to_collection(time, name);
}

// The end tags are overwritten by the next entry and its end tags, in one write.
void GrainSeries::add_to_collection(double time, const std::string& name) {
    constexpr std::string_view end_tags = "</Collection>\n</VTKFile>\n";
    collection_ << fmt::format("<DataSet timestep=\"{:.9g}\" part=\"0\" file=\"{}\"/>\n{}", time,
                               name, end_tags)
                << std::flush;
    if (!collection_)
        throw Failure(ExitCode::participant_failed,
                      "cannot write " + (folder_ / "grains.pvd").string() + ": is the disk full?");
    collection_.seekp(-static_cast<std::streamoff>(end_tags.size()), std::ios::end);
}

}  // namespace turbidite
