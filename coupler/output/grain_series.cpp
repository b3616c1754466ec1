// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/output/grain_series.hpp"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "coupler/rigid/rotation.hpp"
#include "coupler/shapes/shape.hpp"

namespace turbidite {
namespace {

std::filesystem::path made(std::filesystem::path folder) {
    std::filesystem::create_directories(folder);
    return folder;
}

}  // namespace

GrainSeries::GrainSeries(std::filesystem::path folder, const ShapeTable& shapes)
    : GrainSeries(folder, shapes, vtk::Collection(made(folder) / collection_name)) {}

GrainSeries::GrainSeries(std::filesystem::path folder, const ShapeTable& shapes,
                         std::int64_t length)
    : GrainSeries(folder, shapes, vtk::Collection(folder / collection_name, length)) {}

GrainSeries::GrainSeries(std::filesystem::path folder, const ShapeTable& shapes,
                         vtk::Collection series)
    : folder_(std::move(folder)), collection_(std::move(series)) {
    for (const ShapeRecord& shape : shapes) outlines_.push_back(make_shape(shape)->outline());
}

void GrainSeries::write(double time, std::int64_t step, double window, const Motion& state,
                        const std::vector<Kick>& kicks) {
    std::vector<std::string> parts = {fmt::format("grains_{:08d}.vtp", step)};
    write_points(parts[0], window, state, kicks);
    const auto cornered = [](const Outline& outline) { return !outline.empty(); };
    if (std::any_of(outlines_.begin(), outlines_.end(), cornered)) {
        parts.push_back(fmt::format("outlines_{:08d}.vtp", step));
        write_outlines(parts[1], state);
    }
    collection_.add(time, parts);
}

void GrainSeries::write_points(const std::string& name, double window, const Motion& state,
                               const std::vector<Kick>& kicks) const {
    std::unordered_map<GrainId, const Kick*> by_id;
    for (const Kick& kick : kicks) by_id[kick.id] = &kick;
    const auto of_kick = [&](Vec3 Kick::*part) {
        return [&by_id, part](const GrainState& g) {
            const auto at = by_id.find(g.id);
            // Zero at t = 0 and without a fluid, where there are no kicks.
            return at == by_id.end() ? Vec3{} : at->second->*part;
        };
    };
    using Grain = const GrainState&;
    const auto& grains = state.grains;
    const vtk::PieceSize size{.points = grains.size(), .vertices = grains.size()};
    vtk::write_poly_data(folder_ / name, size, [&](std::ostream& out) {
        out << "<Points>\n";
        vtk::vectors(out, "position", grains, [](Grain g) { return g.position; });
        out << "</Points>\n<Verts>\n";
        vtk::consecutive_cells(out, std::vector<std::size_t>(grains.size(), 1));
        out << "</Verts>\n<PointData Scalars=\"radius\" Vectors=\"velocity\">\n";
        vtk::integers(out, "id", grains, [](Grain g) { return g.id; });
        vtk::integers(out, "shape", grains, [](Grain g) { return g.shape; });
        vtk::integers(out, "material", grains, [](Grain g) { return g.material; });
        vtk::integers(out, "prescribed", grains, [](Grain g) { return g.prescribed ? 1 : 0; });
        vtk::scalars(out, "radius", grains, [](Grain g) { return g.radius; });
        vtk::scalars(out, "density", grains, [](Grain g) { return g.density; });
        vtk::data_array(out, "type=\"Float64\" Name=\"orientation\" NumberOfComponents=\"4\"",
                        grains, [](Grain g) {
                            const Quaternion& q = g.orientation;
                            return fmt::format("{:.9g} {:.9g} {:.9g} {:.9g}\n", q[0], q[1], q[2],
                                               q[3]);
                        });
        vtk::vectors(out, "velocity", grains, [](Grain g) { return g.velocity; });
        vtk::vectors(out, "angular_velocity", grains, [](Grain g) { return g.angular_velocity; });
        vtk::vectors(out, "force", grains, of_kick(&Kick::force));
        vtk::vectors(out, "torque", grains, of_kick(&Kick::torque));
        vtk::vectors(out, "contact_force", grains,
                     // The mean force of the window: F_c = J_c/dt
                     [&](Grain g) { return g.contact_impulse / window; });
        out << "</PointData>\n";
    });
}

void GrainSeries::write_outlines(const std::string& name, const Motion& state) const {
    std::vector<const GrainState*> grains;
    std::vector<std::size_t> corners;
    std::vector<Vec3> points;
    for (const GrainState& grain : state.grains) {
        const Outline& outline = outlines_.at(static_cast<std::size_t>(grain.shape));
        if (outline.empty()) continue;
        grains.push_back(&grain);
        corners.push_back(outline.size());
        // Rows of R: x = centre + R (x_body, y_body, 0)
        const auto& [along_x, along_y, along_z] = rotation(grain.orientation);
        for (const auto& [u, v] : outline) {
            const double x = grain.radius * u, y = grain.radius * v;
            points.push_back({grain.position[0] + along_x[0] * x + along_x[1] * y,
                              grain.position[1] + along_y[0] * x + along_y[1] * y, 0.0});
        }
    }
    using Grain = const GrainState*;
    const vtk::PieceSize size{.points = points.size(), .polygons = grains.size()};
    vtk::write_poly_data(folder_ / name, size, [&](std::ostream& out) {
        out << "<Points>\n";
        vtk::vectors(out, "position", points, [](const Vec3& point) { return point; });
        out << "</Points>\n<Polys>\n";
        vtk::consecutive_cells(out, corners);
        out << "</Polys>\n<CellData Scalars=\"id\" Vectors=\"velocity\">\n";
        vtk::integers(out, "id", grains, [](Grain g) { return g->id; });
        vtk::integers(out, "shape", grains, [](Grain g) { return g->shape; });
        vtk::vectors(out, "velocity", grains, [](Grain g) { return g->velocity; });
        vtk::vectors(out, "angular_velocity", grains, [](Grain g) { return g->angular_velocity; });
        out << "</CellData>\n";
    });
}

}  // namespace turbidite
