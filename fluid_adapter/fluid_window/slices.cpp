// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/fluid_window/slices.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "fluid_adapter/multiplier/covered_share.hpp"

namespace turbidite {
namespace {

constexpr std::size_t per_cell = 5;  // p, u, v, w, covered
constexpr int lines = 8;             // that find the covered share of a cell's cut

std::size_t cells_of(const CellGrid& grid, int across, int up) {
    return static_cast<std::size_t>(grid.counts[across]) * grid.counts[up];
}

SliceArray array_of(const std::vector<double>& values, const char* name, std::size_t first,
                    int components) {
    SliceArray array{name, components, {}};
    for (std::size_t cell = 0; cell < values.size(); cell += per_cell)
        for (int c = 0; c < components; ++c)
            array.values.push_back(static_cast<float>(values[cell + first + c]));
    return array;
}

}  // namespace

std::vector<double> edges_along(const CellGrid& grid, int axis) {
    std::vector<double> edges;
    for (int i = 0; i < grid.counts[axis]; ++i)
        edges.push_back(grid.centre(axis, i) - 0.5 * grid.size(axis, i));
    edges.push_back(grid.origin[axis] + grid.length(axis));
    return edges;
}

Slices::Slices(const Settings& settings, const CellGrid& grid, std::filesystem::path fluid_case)
    : run_(run_values(settings)), folder_(std::move(fluid_case) / "slices") {
    if (!settings.has("run.slices")) return;
    std::istringstream numbers(settings.text("run.slices"));
    double place = 0.0;
    for (int normal = 0; numbers >> normal >> place;) planes_.push_back(plane(grid, normal, place));
    if (!planes_.empty()) std::filesystem::create_directories(folder_);
}

Slices::Plane Slices::plane(const CellGrid& grid, int normal, double place) const {
    std::ostringstream name;
    name << "xyz"[normal] << place / run_.diameter;
    // A plane on the upper side of the box lies in no layer: it gets the last one.
    const int layer = std::clamp(grid.layer(normal, place), 0, grid.counts[normal] - 1);
    return {
        normal, normal == 0 ? 1 : 0, normal == 2 ? 1 : 2, place, axis_stencil(grid, normal, place),
        layer,  name.str()};
}

/// Each rank writes what is in its own cells.
void Slices::write(const StoredField& field, const RankGroup& ranks,
                   const std::vector<ImmersedGrain>& grains, std::int64_t windows) const {
    for (const Plane& plane : planes_) {
        std::vector<double> values = sampled(plane, field);
        for (const ImmersedGrain& grain : grains) cover(plane, field, grain, values);
        ranks.sum(values.data(), static_cast<int>(values.size()));
        if (ranks.rank() != 0) continue;
        write_slice(folder_ / slice_file_name(plane.name, windows), edges(plane, field.grid()),
                    {array_of(values, "p", 0, 1), array_of(values, "U", 1, 3),
                     array_of(values, "covered", 4, 1)});
    }
    if (planes_.empty() || ranks.rank() != 0) return;
    std::vector<std::string> names;
    for (const Plane& plane : planes_) names.push_back(plane.name);
    write_slice_series(folder_ / "slices.pvd", names, run_.step);
}

std::vector<double> Slices::sampled(const Plane& plane, const StoredField& field) const {
    const CellGrid& grid = field.grid();
    std::vector<double> values(per_cell * cells_of(grid, plane.across, plane.up), 0.0);
    double* value = values.data();
    CellIndex at{};
    for (at[plane.up] = 0; at[plane.up] < grid.counts[plane.up]; ++at[plane.up])
        for (at[plane.across] = 0; at[plane.across] < grid.counts[plane.across];
             ++at[plane.across], value += per_cell)
            // A rank adds its layer's share; the other layer may be another rank's.
            for (const int end : {0, 1}) {
                at[plane.normal] = plane.stencil.layer[end];
                const int cell = field.cell(at[0], at[1], at[2]);
                if (cell < 0) continue;
                const double weight = plane.stencil.weight(end);
                const Vec3 u = field.shown_velocity(cell);
                value[0] += weight * field.shown_pressure(cell);
                for (int axis = 0; axis < 3; ++axis) value[1 + axis] += weight * u[axis];
            }
    return values;
}

/// The rank that has the cell which the plane cuts knows the grain.
void Slices::cover(const Plane& plane, const StoredField& field, const ImmersedGrain& grain,
                   std::vector<double>& values) const {
    if (grain.wall) return cover(plane, field, *grain.wall, values);
    const CellGrid& grid = field.grid();
    const auto [normal, across, up] = std::array{plane.normal, plane.across, plane.up};
    Eigen::Vector3d off = Eigen::Vector3d::Zero();
    off[normal] = plane.place - grain.position[normal];
    // Of a sphere that crosses a cyclic side the image that the plane cuts.
    off = grid.nearest_image(off);
    if (std::abs(off[normal]) >= grain.radius) return;
    Eigen::Vector3d centre = grain.position;
    centre[normal] = plane.place - off[normal];
    // Radius of the circle in the plane
    const double reach = std::sqrt(grain.radius * grain.radius - off[normal] * off[normal]);
    const auto layer = [&](int axis, double side) {
        return grid.layer(axis, centre[axis] + side * reach);
    };
    CellIndex at{};
    at[normal] = plane.layer;
    Vec3 place{};
    place[normal] =
        (plane.place - grid.centre(normal, plane.layer)) / grid.size(normal, plane.layer);
    for (at[up] = layer(up, -1.0); at[up] <= layer(up, 1.0); ++at[up])
        for (at[across] = layer(across, -1.0); at[across] <= layer(across, 1.0); ++at[across]) {
            CellIndex inside = at;
            for (int axis = 0; axis < 3; ++axis) inside[axis] = grid.wrapped(axis, at[axis]);
            if (field.cell(inside[0], inside[1], inside[2]) < 0) continue;
            double sum = 0.0;
            for (int line = 0; line < lines; ++line) {
                place[up] = (line + 0.5) / lines - 0.5;
                sum += covered_length(grid, centre, grain.radius, across, at, place);
            }
            add_covered(plane, grid, inside, sum / lines, values);
        }
}

void Slices::cover(const Plane& plane, const StoredField& field, const WallBody& wall,
                   std::vector<double>& values) const {
    const CellGrid& grid = field.grid();
    const auto [first, last] = layers_reached_by(grid, wall);
    CellIndex at{};
    for (at[0] = first[0]; at[0] <= last[0]; ++at[0])
        for (at[1] = first[1]; at[1] <= last[1]; ++at[1])
            for (at[2] = first[2]; at[2] <= last[2]; ++at[2]) {
                CellIndex inside{};
                for (int axis = 0; axis < 3; ++axis) inside[axis] = grid.wrapped(axis, at[axis]);
                if (inside[plane.normal] != plane.layer) continue;
                if (field.cell(inside[0], inside[1], inside[2]) < 0) continue;
                add_covered(plane, grid, inside, covered_share(grid, wall, at), values);
            }
}

void Slices::add_covered(const Plane& plane, const CellGrid& grid, const CellIndex& cell,
                         double share, std::vector<double>& values) {
    const std::size_t in_plane =
        cell[plane.across] + static_cast<std::size_t>(grid.counts[plane.across]) * cell[plane.up];
    double& covered = values[per_cell * in_plane + 4];
    covered = std::min(1.0, covered + share);
}

SliceEdges Slices::edges(const Plane& plane, const CellGrid& grid) const {
    SliceEdges edges;
    for (int axis = 0; axis < 3; ++axis)
        edges[axis] =
            axis == plane.normal ? std::vector<double>{plane.place} : edges_along(grid, axis);
    return edges;
}

}  // namespace turbidite
