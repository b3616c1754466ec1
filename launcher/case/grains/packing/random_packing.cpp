// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/grains/packing/random_packing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "launcher/case/grains/grain_forms.hpp"
#include "launcher/case/grains/packing/lattice.hpp"
#include "launcher/case/grains/packing/neighbour_grid.hpp"
#include "launcher/case/grains/packing/random_numbers.hpp"

namespace turbidite {
namespace {

constexpr std::array gaps{0.1, 0.05, 0.02, 0.005, 0.0};  // [D] tried in this order
constexpr double least_gap = 0.005;                      // for grains other than unit discs
constexpr int shaking_sweeps = 100;

const GrainForm* form_of(const PackingRequest& request) {
    return request.forms ? &request.forms->forms[0] : nullptr;
}

bool has_corners(const PackingRequest& request) {
    return request.forms && !form_of(request)->outline.empty();
}

double mean_radius(const PackingRequest& request) {
    return request.forms ? form_of(request)->radius : 0.5;
}

bool are_unit_discs(const PackingRequest& request) {
    return !has_corners(request) && mean_radius(request) == 0.5 && request.size_ratio == 1.0;
}

// The gap applies to walls as well, so that no grain is in contact at the start.
PlacedGrain random_place(const PackingRegion& region, double edge, RandomNumbers& random) {
    return {.x = random.uniform(edge, region.width - edge),
            .y = random.uniform(edge, region.height - edge)};
}

bool add_one(NeighbourGrid& grid, const PackingRequest& request, double radius, double gap,
             RandomNumbers& random) {
    const PackingRegion region = request.filled();
    if (region.width < 2.0 * (radius + gap) || region.height < 2.0 * (radius + gap)) return false;
    for (int attempt = 0; attempt < attempts_per_grain; ++attempt) {
        PlacedGrain grain = random_place(region, radius + gap, random);
        if (has_corners(request)) grain.angle = random.uniform(0.0, 2.0 * std::numbers::pi);
        grain.radius = radius;
        grain.id = static_cast<GrainId>(grid.grains().size());
        // Random sequential addition: a place that is taken is thrown away, nothing moves.
        if (!grid.is_free(grain, gap)) continue;
        grid.insert(grain);
        return true;
    }
    return false;
}

/// Empty if the grains did not fit with this gap.
Packing add_one_by_one(const PackingRequest& request, double gap) {
    // Begun anew for every gap: the packing does not depend on the gaps that failed.
    RandomNumbers random(request.seed);
    const std::vector<double> radii = draw_radii(request, random);
    NeighbourGrid grid(request.box, radii.empty() ? 0.5 : radii.front(), gap, request.forms);
    for (const double radius : radii)
        if (!add_one(grid, request, radius, gap, random)) return {};
    return grid.grains();
}

Packing lattice_of(const PackingRequest& request, double compacity) {
    PackingRequest plain = request;
    plain.compacity = compacity;
    plain.jitter = 0.0;
    return lattice_packing(plain).grains;
}

/// The loosest of a few lattices that has enough sites; empty if even the densest has too few.
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
        // Fisher and Yates: every choice of sites is equally likely.
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
        // Other displacements in every sweep.
        shaking.seed = request.seed + static_cast<std::uint64_t>(sweep);
        shake(grains, shaking, request.filled());
    }
    return grains;
}

std::string does_not_fit(const PackingRequest& request) {
    if (!are_unit_discs(request))
        return fmt::format(
            "A box of {} x {} D has no room for them at random places {} D apart. Ask for fewer "
            "grains or enlarge {}.",
            request.filled().width, request.filled().height, least_gap,
            request.region ? "grains.region" : "domain.size");
    const auto most = lattice_of(request, densest_compacity()).size();
    return fmt::format(
        "A box of {} x {} D holds at most {} grains in the densest lattice. "
        "Ask for fewer grains or enlarge {}.",
        request.filled().width, request.filled().height, most,
        request.region ? "grains.region" : "domain.size");
}

/// Of a grain of unit circumscribed radius.
double unit_area(const PackingRequest& request) {
    if (!has_corners(request)) return std::numbers::pi;
    const std::vector<Point2>& corners = form_of(request)->outline;
    double twice = 0.0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Point2 &a = corners[i], &b = corners[(i + 1) % corners.size()];
        // Twice the area of the triangle (0, a, b).
        twice += a[0] * b[1] - b[0] * a[1];
    }
    return 0.5 * std::abs(twice);
}

/// Whether the grains would fill more of the region than the densest packing of equal discs does,
/// or all of it: known at once, while trying takes minutes.
bool is_overfull(const PackingRequest& request) {
    const double radius = mean_radius(request);
    const double share = are_unit_discs(request) ? densest_compacity() : 1.0;
    const PackingRegion region = request.filled();
    return static_cast<double>(request.count) * radius * radius * unit_area(request) >
           share * region.width * region.height;
}

double smallest_radius_of(const PackingRequest& request) {
    return smallest_radius(mean_radius(request), request.size_ratio);
}

}  // namespace

double smallest_radius(double mean, double size_ratio) {
    return 2.0 * mean / (1.0 + size_ratio);
}

std::vector<double> draw_radii(const PackingRequest& request, RandomNumbers& random) {
    std::vector<double> radii(static_cast<std::size_t>(request.count), mean_radius(request));
    if (request.size_ratio == 1.0) return radii;
    // 2 R/(1 + q) to 2 R q/(1 + q): the mean is R
    const double smallest = smallest_radius_of(request);
    for (double& radius : radii) radius = random.uniform(smallest, smallest * request.size_ratio);
    // Large ones first: small ones find room between them later.
    std::sort(radii.begin(), radii.end(), std::greater<>());
    return radii;
}

double solid_volume(const std::vector<double>& radii) {
    double sum = 0.0;
    for (const double r : radii) sum += 4.0 / 3.0 * std::numbers::pi * r * r * r;
    return sum;
}

double least_solid_fraction(const PackingRequest& request) {
    return static_cast<double>(request.count) * solid_volume({smallest_radius_of(request)}) /
           request.filled().volume();
}

PackingResult random_packing(const PackingRequest& request) {
    PackingResult result;
    if (is_overfull(request)) {
        result.refusal = does_not_fit(request);
        return result;
    }
    for (const double gap : gaps) {
        if (gap < least_gap && !are_unit_discs(request)) break;
        result.grains = add_one_by_one(request, gap);
        if (result.grains.empty()) continue;
        result.notes.push_back(
            fmt::format("{} grains placed at random, at least {} D apart", request.count, gap));
        apply_jitter(result, request);
        return result;
    }
    if (are_unit_discs(request)) result.grains = shaken_sites(request);
    if (result.grains.empty())
        result.refusal = does_not_fit(request);
    else
        result.notes.push_back(
            fmt::format("{} grains are too many for random placement; random sites of a lattice "
                        "were used and shaken; grains may touch",
                        request.count));
    return result;
}

}  // namespace turbidite
