// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/domain/fluid_domain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "coupler/protocol/failure.hpp"
#include "coupler/protocol/run_values.hpp"
#include "coupler/protocol/scene/mesh_rows.hpp"

namespace turbidite {
namespace {

int cell_count(const char* key, double size, double per_length) {
    const double cells = std::round(size * per_length);
    if (!(cells >= fewest_cells && cells < 1e6))
        throw Failure(ExitCode::bad_input,
                      fmt::format("{} = {} gives {} cells; allowed are {} to a million: change "
                                  "domain.size or fluid.cells_per_diameter",
                                  key, size, cells, fewest_cells));
    return static_cast<int>(cells);
}

/// Rows above fluid.stretch_from.
void stretch_rows(const Settings& settings, const RunValues& run, FluidDomain& domain) {
    const std::optional<MeshRows> rows = mesh_rows(settings, run.size[1] / run.diameter);
    if (!rows || domain.sides[2] == "cyclic")
        throw Failure(ExitCode::bad_input,
                      fmt::format("fluid.stretch_from = {}: rows cannot be stretched between there "
                                  "and the top at {} D{}; lower it, or set fluid.stretch_ratio = 1",
                                  settings.real("fluid.stretch_from"), run.size[1] / run.diameter,
                                  rows ? ", which is cyclic" : ""));
    domain.cells[1] = rows->count();
    domain.equal_height = rows->equal_height() * run.diameter;
    for (int j = 0; j <= rows->equal; ++j)
        domain.row_edges.push_back(j * rows->height * run.diameter);
    for (const double height : rows->stretched)
        domain.row_edges.push_back(domain.row_edges.back() + height * run.diameter);
    domain.row_edges.back() = run.size[1];
}

}  // namespace

std::vector<int> first_layers(const Settings& settings, int layers, int ranks) {
    std::vector<int> first;
    if (!settings.has("run.fluid_layers")) {
        for (int rank = 0; rank <= ranks; ++rank)
            first.push_back((rank * layers + ranks - 1) / ranks);
        return first;
    }
    first.push_back(0);
    std::istringstream counts(settings.text("run.fluid_layers"));
    for (int count = 0; counts >> count;) first.push_back(first.back() + count);
    if (std::ssize(first) != ranks + 1 || first.back() != layers ||
        !std::is_sorted(first.begin(), first.end()))
        throw Failure(ExitCode::bad_input,
                      fmt::format("run.fluid_layers = {} are not the {} layers of {} ranks",
                                  settings.text("run.fluid_layers"), layers, ranks));
    return first;
}

FluidDomain fluid_domain(const Settings& settings) {
    FluidDomain domain;
    const RunValues run = run_values(settings);
    const double per_length = settings.real("fluid.cells_per_diameter") / run.diameter;
    const char* keys[] = {"run.size_x", "run.size_y", "run.size_z"};
    domain.dimension = run.dimension;
    for (int axis = 0; axis < run.dimension; ++axis) {
        domain.size[axis] = run.size[axis];
        domain.cells[axis] = cell_count(keys[axis], run.size[axis], per_length);
    }
    if (run.dimension == 2) domain.size[2] = domain.size[0] / domain.cells[0];
    domain.equal_height = run.size[1];
    domain.sides = side_types(settings);
    if (rows_are_stretched(settings)) stretch_rows(settings, run, domain);
    return domain;
}

}  // namespace turbidite
