// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/fluid_cut.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "coupler/keys/key_spec.hpp"
#include "coupler/keys/key_value.hpp"
#include "coupler/protocol/scene/mesh_rows.hpp"

namespace turbidite {
namespace {

// What a covered cell costs more than one of fluid, over that one; measured: discs with points on
// their surfaces under `joint`, spheres with interior points.
constexpr double covered_in_plane = 4.0, covered_in_space = 1.5;

/// Edges of the layers, ascending [D].
std::vector<double> layer_edges(const Settings& settings, double top) {
    std::vector<double> edges{0.0};
    if (rows_are_stretched(settings)) {
        if (const auto rows = mesh_rows(settings, top)) {
            for (int j = 1; j <= rows->equal; ++j) edges.push_back(j * rows->height);
            for (const double height : rows->stretched) edges.push_back(edges.back() + height);
            return edges;
        }
    }
    const auto count = std::lround(top * settings.real("fluid.cells_per_diameter"));
    for (long j = 1; j <= count; ++j)
        edges.push_back(top * static_cast<double>(j) / static_cast<double>(count));
    return edges;
}

/// Cells of a layer at the height dy above the centre that a round grain covers, with so many cells
/// per D.
double covered(double radius, double dy, double cells, bool space) {
    const double squared = radius * radius - dy * dy;  // of half the chord [D^2]
    if (squared <= 0.0) return 0.0;
    return space ? std::numbers::pi * squared * cells * cells : 2.0 * std::sqrt(squared) * cells;
}

/// Work of the layers, in cells of fluid alone.
std::vector<double> weights(const Settings& settings, const Packing& grains) {
    const bool space = in_space(settings);
    const double cells = settings.real("fluid.cells_per_diameter");
    const auto size = real_list("domain.size", settings.text("domain.size"));
    const std::vector<double> edges = layer_edges(settings, size.at(1));
    const double fluid = size.at(0) * cells * (space ? size.at(2) * cells : 1.0);
    const double more = space ? covered_in_space : covered_in_plane;
    std::vector<double> work(edges.size() - 1, fluid);
    for (const PlacedGrain& grain : grains) {
        const auto above = std::upper_bound(edges.begin(), edges.end(), grain.y - grain.radius);
        for (auto j = std::max<std::ptrdiff_t>(above - edges.begin() - 1, 0);
             j < std::ssize(work) && edges[j] < grain.y + grain.radius; ++j)
            work[j] += more * covered(grain.radius, 0.5 * (edges[j] + edges[j + 1]) - grain.y,
                                      cells, space);
    }
    return work;
}

}  // namespace

std::vector<int> cut_evenly(const std::vector<double>& weights, int parts, int least) {
    const double all = std::accumulate(weights.begin(), weights.end(), 0.0);
    const int layers = static_cast<int>(weights.size());
    std::vector<int> counts;
    double below = 0.0;  // the weight of the layers up to `next`
    for (int part = 1, first = 0, next = 0; part <= parts; ++part, first = next) {
        const double wanted = all * part / parts;
        const int most = layers - least * (parts - part);
        // A layer belongs to the part in which more than half of its weight lies.
        while (next < most &&
               (next - first < least || part == parts || below + 0.5 * weights[next] < wanted))
            below += weights[next++];
        counts.push_back(next - first);
    }
    return counts;
}

std::vector<int> cut_by_work(const Settings& settings, const Packing& grains) {
    const auto ranks = static_cast<int>(settings.integer("fluid.ranks"));
    if (!settings.flag("fluid.enabled") || ranks == 1 ||
        !is(settings, "fluid.decomposition", "rows"))
        return {};
    return cut_evenly(weights(settings, grains), ranks, least_layers);
}

}  // namespace turbidite
