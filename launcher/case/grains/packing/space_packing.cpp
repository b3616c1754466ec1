// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/grains/packing/space_packing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <utility>

#include "launcher/case/grains/packing/lattice.hpp"
#include "launcher/case/grains/packing/neighbour_grid.hpp"
#include "launcher/case/grains/packing/pouring.hpp"
#include "launcher/case/grains/packing/random_numbers.hpp"
#include "launcher/case/grains/packing/random_packing.hpp"
#include "launcher/case/grains/packing/space_lattice.hpp"

namespace turbidite {
namespace {

constexpr std::array space_gaps{0.1, 0.05, 0.02, 0.005};  // [D] tried in this order
constexpr int sphere_sweeps = 30;
// Random sequential addition of equal spheres ends at 0.38; from here on most attempts fail.
constexpr double one_by_one_fraction = 0.3;

PlacedGrain random_place_in_space(const PackingRegion& region, double edge, RandomNumbers& random) {
    PlacedGrain grain{.x = region.corner[0] + random.uniform(edge, region.width - edge),
                      .y = region.corner[1] + random.uniform(edge, region.height - edge)};
    grain.z = region.corner[2] + random.uniform(edge, region.depth - edge);
    return grain;
}

// The gap applies to walls as well, so that no grain is in contact at the start.
bool add_one(NeighbourGrid& grid, const PackingRegion& region, double radius, double gap,
             RandomNumbers& random) {
    const double least = 2.0 * (radius + gap);
    if (region.width < least || region.height < least || region.depth < least) return false;
    for (int attempt = 0; attempt < attempts_per_grain; ++attempt) {
        PlacedGrain grain = random_place_in_space(region, radius + gap, random);
        grain.radius = radius;
        grain.id = static_cast<GrainId>(grid.grains().size());
        if (region.cylinder && !region.holds({grain.x, grain.y, grain.z}, radius + gap)) continue;
        if (!grid.is_free(grain, gap)) continue;
        grid.insert(grain);
        return true;
    }
    return false;
}

/// Empty if the grains did not fit with this gap.
Packing add_one_by_one(const PackingRequest& request, const std::vector<double>& radii, double gap,
                       RandomNumbers random) {
    NeighbourGrid grid(request.box, radii.front(), gap, request.forms);
    for (const double radius : radii)
        if (!add_one(grid, request.filled(), radius, gap, random)) return {};
    return grid.grains();
}

/// The loosest of a few lattices for the largest sphere with enough sites; empty if even the
/// densest has too few.
Packing enough_sites(const PackingRequest& request, double largest) {
    constexpr int steps = 64;
    const SpaceLattice& lattice = space_lattice("fcc");
    const std::vector<double> all_largest(static_cast<std::size_t>(request.count), largest);
    // Looser ones than this cannot have enough: the search begins there.
    const double needed = solid_volume(all_largest) / request.filled().volume();
    for (int i = std::max(1, static_cast<int>(steps * needed / lattice.densest())); i <= steps;
         ++i) {
        Packing sites =
            lattice_sites(lattice, request.filled(), largest, lattice.densest() * i / steps);
        if (static_cast<std::int64_t>(sites.size()) >= request.count) return sites;
    }
    return {};
}

/// The first sites after shuffling them, with the radii.
Packing on_random_sites(Packing sites, const std::vector<double>& radii, RandomNumbers& random) {
    for (std::size_t i = 0; i < radii.size(); ++i) {
        const auto rest = static_cast<std::int64_t>(sites.size() - i);
        std::swap(sites[i], sites[i + static_cast<std::size_t>(random.index(rest))]);
        sites[i].id = static_cast<GrainId>(i);
        sites[i].radius = radii[i];
    }
    sites.resize(radii.size());
    return sites;
}

Packing shaken_sites(const PackingRequest& request, const std::vector<double>& radii,
                     RandomNumbers random) {
    Packing sites = enough_sites(request, radii.front());
    if (sites.empty()) return {};
    Packing grains = on_random_sites(std::move(sites), radii, random);
    PackingRequest shaking = request;
    shaking.jitter = shaking_distance;
    for (int sweep = 0; sweep < sphere_sweeps; ++sweep) {
        shaking.seed = request.seed + static_cast<std::uint64_t>(sweep);
        shake(grains, shaking, request.filled());
    }
    return grains;
}

std::string words_of(const PackingRegion& region) {
    if (region.cylinder) return fmt::format("a cylinder of {:.4g} D3", region.volume());
    return fmt::format("{} x {} x {} D", region.width, region.height, region.depth);
}

std::string too_dense_for_random(const PackingRequest& request, double fraction) {
    return fmt::format(
        "They fill {:.3g} of {}; at random places at most {} are possible. {} for fewer grains, "
        "or use grains.generator: lattice.",
        fraction, words_of(request.filled()), largest_random_fraction,
        fraction > densest_poured ? "Ask"
        : request.filled().cylinder
            ? "Pour them: let fewer per volume fall in a higher box, and start from that run with "
              "run --from. Or ask"
            : "Use grains.generator: poured, which lets them fall into the region first. Or ask");
}

std::string spheres_do_not_fit(const PackingRequest& request) {
    return fmt::format("There is no room for them in {}. Ask for fewer grains or enlarge {}.",
                       words_of(request.filled()),
                       request.filled().cylinder ? "grains.cylinder"
                       : request.region          ? "grains.region"
                                                 : "domain.size");
}

}  // namespace

PackingResult random_space_packing(const PackingRequest& request) {
    PackingResult result;
    if (const double least = least_solid_fraction(request); least > largest_random_fraction) {
        result.refusal = too_dense_for_random(request, least);
        return result;
    }
    RandomNumbers random(request.seed);
    // Before any place is drawn: the radii do not depend on how often places fail.
    const std::vector<double> radii = draw_radii(request, random);
    const double fraction = solid_volume(radii) / request.filled().volume();
    if (fraction > largest_random_fraction) {
        result.refusal = too_dense_for_random(request, fraction);
        return result;
    }
    if (fraction <= one_by_one_fraction)
        for (const double gap : space_gaps) {
            result.grains = add_one_by_one(request, radii, gap, random);
            if (result.grains.empty()) continue;
            result.notes.push_back(
                fmt::format("{} grains placed at random, at least {} D apart", request.count, gap));
            apply_jitter(result, request);
            return result;
        }
    result.grains = shaken_sites(request, radii, random);
    if (result.grains.empty())
        result.refusal = spheres_do_not_fit(request);
    else
        result.notes.push_back(fmt::format(
            "{} grains were placed on random sites of a lattice and shaken", request.count));
    return result;
}

}  // namespace turbidite
