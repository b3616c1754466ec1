// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/case/random_packing.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "coupler/case/lattice.hpp"
#include "coupler/case/neighbour_grid.hpp"
#include "coupler/case/random_numbers.hpp"

namespace turbidite {
namespace {

constexpr std::array gaps{0.1, 0.05, 0.02, 0.005, 0.0};  // [D] tried in this order
constexpr int attempts_per_grain = 500;
constexpr int shaking_sweeps = 100;
constexpr double shaking_distance = 0.2;  // [D]

// Walls take the gap as well, so that no grain starts in touch with anything.
PlacedGrain random_place(const PackingRegion& region, double gap, RandomNumbers& random) {
    const double edge = 0.5 + gap;
    return {.x = random.uniform(edge, region.width - edge),
            .y = random.uniform(edge, region.height - edge)};
}

bool add_one(NeighbourGrid& grid, const PackingRegion& region, double gap, RandomNumbers& random) {
    for (int attempt = 0; attempt < attempts_per_grain; ++attempt) {
        PlacedGrain grain = random_place(region, gap, random);
        grain.id = static_cast<GrainId>(grid.grains().size());
        if (!grid.is_free(grain, gap)) continue;
        grid.insert(grain);
        return true;
    }
    return false;
}

/// Empty when the grains did not fit with this gap.
Packing add_one_by_one(const PackingRequest& request, double gap) {
    const PackingRegion region = request.filled();
    if (region.width < 1.0 + 2.0 * gap || region.height < 1.0 + 2.0 * gap) return {};
    RandomNumbers random(request.seed);
    NeighbourGrid grid(request.box, 0.5, gap);
    for (std::int64_t i = 0; i < request.count; ++i)
        if (!add_one(grid, region, gap, random)) return {};
    return grid.grains();
}

Packing lattice_of(const PackingRequest& request, double compacity) {
    PackingRequest plain = request;
    plain.compacity = compacity;
    plain.jitter = 0.0;
    return lattice_packing(plain).grains;
}

/// The loosest of a few lattices that has enough sites; empty when even the densest has not.
Packing enough_sites(const PackingRequest& request) {
    constexpr int steps = 32;
    const double low = loosest_compacity();
    const double high = densest_compacity();
    for (int i = 0; i <= steps; ++i) {
        Packing sites = lattice_of(request, low + (high - low) * i / steps);
        if (static_cast<std::int64_t>(sites.size()) >= request.count) return sites;
    }
    return {};
}

void keep_random_sites(Packing& sites, std::int64_t count, RandomNumbers& random) {
    for (std::int64_t i = 0; i < count; ++i) {
        const auto rest = static_cast<std::int64_t>(sites.size()) - i;
        std::swap(sites[i], sites[i + random.index(rest)]);
        sites[i].id = i;
    }
    sites.resize(count);
}

Packing shaken_sites(const PackingRequest& request) {
    Packing grains = enough_sites(request);
    if (grains.empty()) return {};
    RandomNumbers random(request.seed);
    keep_random_sites(grains, request.count, random);
    PackingRequest shaking = request;
    shaking.jitter = shaking_distance;
    for (int sweep = 0; sweep < shaking_sweeps; ++sweep) {
        shaking.seed = request.seed + static_cast<std::uint64_t>(sweep);
        shake(grains, shaking, request.filled());
    }
    return grains;
}

std::string does_not_fit(const PackingRequest& request) {
    const auto most = lattice_of(request, densest_compacity()).size();
    return fmt::format(
        "A box of {} x {} D holds at most {} grains in the densest lattice. "
        "Ask for fewer grains or enlarge {}.",
        request.filled().width, request.filled().height, most,
        request.region ? "grains.region" : "domain.size");
}

}  // namespace

PackingResult random_packing(const PackingRequest& request) {
    PackingResult result;
    for (const double gap : gaps) {
        result.grains = add_one_by_one(request, gap);
        if (result.grains.empty()) continue;
        result.notes.push_back(
            fmt::format("{} grains placed at random, at least {} D apart", request.count, gap));
        apply_jitter(result, request);
        return result;
    }
    result.grains = shaken_sites(request);
    if (result.grains.empty())
        result.refusal = does_not_fit(request);
    else
        result.notes.push_back(fmt::format(
            "{} grains are too many for random placing; random sites of a lattice were taken and "
            "shaken, grains may touch",
            request.count));
    return result;
}

}  // namespace turbidite
