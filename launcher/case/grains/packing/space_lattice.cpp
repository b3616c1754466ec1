// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/grains/packing/space_lattice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "coupler/keys/key_value.hpp"
#include "launcher/case/grains/packing/lattice.hpp"

namespace turbidite {
namespace {

constexpr double clamping_distance = 1e-3;  // in compacity, as in the plane

/// More cells than any packing has: a box of 1e300 D is refused elsewhere.
constexpr double most_lattice_cells = 1e9;

/// Cells along an axis of which the first site is inside.
std::int64_t cells_along(double length, double radius, double edge) {
    const double cells = std::floor((length - 2.0 * radius + fit_rounding) / edge) + 1.0;
    return static_cast<std::int64_t>(std::clamp(cells, 0.0, most_lattice_cells));
}

PlacedGrain sphere_at(const Vec3& place, double radius, std::size_t index) {
    PlacedGrain grain{
        .id = static_cast<GrainId>(index), .x = place[0], .y = place[1], .radius = radius};
    grain.z = place[2];
    return grain;
}

}  // namespace

double SpaceLattice::densest() const {
    // phi = N (pi/6) D^3 / a^3, with D = 1
    return std::numbers::pi / 6.0 * static_cast<double>(sites.size()) / (edge * edge * edge);
}

const std::vector<SpaceLattice>& space_lattices() {
    static const std::vector<SpaceLattice> lattices = {
        {"fcc",
         "face-centred cubic, up to 0.7405",
         std::numbers::sqrt2,
         {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}}},
        {"bcc",
         "body-centred cubic, up to 0.6802",
         2.0 / std::numbers::sqrt3,
         {{0, 0, 0}, {0.5, 0.5, 0.5}}},
        {"sc", "simple cubic, up to 0.5236", 1.0, {{0, 0, 0}}},
    };
    return lattices;
}

const SpaceLattice& space_lattice(const std::string& name) {
    for (const SpaceLattice& lattice : space_lattices())
        if (lattice.name == name) return lattice;
    throw std::invalid_argument("grains.lattice = \"" + name + "\"; allowed are fcc, bcc, sc");
}

// Layer by layer from below, so that ids ascend with height.
Packing lattice_sites(const SpaceLattice& lattice, const PackingRegion& region, double radius,
                      double compacity, std::size_t most) {
    // a (phi_densest/phi)^(1/3), of spheres of diameter 2 R
    const double edge =
        2.0 * radius * lattice.edge * std::cbrt(std::max(1.0, lattice.densest() / compacity));
    const std::int64_t nx = cells_along(region.width, radius, edge);
    const std::int64_t ny = cells_along(region.height, radius, edge);
    const std::int64_t nz = cells_along(region.depth, radius, edge);
    Packing grains;
    for (std::int64_t j = 0; j < ny; ++j)
        for (std::int64_t k = 0; k < nz; ++k)
            for (std::int64_t i = 0; i < nx; ++i)
                for (const Vec3& site : lattice.sites) {
                    const Vec3 steps{i + site[0], j + site[1], k + site[2]};
                    const Vec3 place =
                        region.corner + (Vec3{radius, radius, radius} + edge * steps);
                    // The last cell along an axis has its first site inside, but not all of them;
                    // in a cylinder any may be outside.
                    if (!region.holds(place, radius)) continue;
                    grains.push_back(sphere_at(place, radius, grains.size()));
                    if (grains.size() == most) return grains;
                }
    return grains;
}

PackingResult space_lattice_packing(const PackingRequest& request) {
    PackingResult result;
    const SpaceLattice& lattice = space_lattice(request.lattice);
    const double densest = lattice.densest();
    if (request.compacity > densest + clamping_distance) {
        result.refusal = fmt::format(
            "The {} lattice has compacities up to {:.4f}; equal spheres have none above 0.7405 "
            "(fcc). Choose a smaller one, or another grains.lattice.",
            lattice.name, densest);
        return result;
    }
    const double used = std::min(request.compacity, densest);
    if (used != request.compacity)
        result.notes.push_back(
            fmt::format("grains.compacity = {} is clamped to {:.6f}, that of "
                        "the densest {} lattice",
                        request.compacity, used, lattice.name));
    result.grains = lattice_sites(lattice, request.filled(), 0.5, used);
    if (result.grains.empty()) result.refusal = "The box is too small for a single grain.";
    apply_jitter(result, request);
    return result;
}

void choose_compacity(Settings& settings) {
    if (settings.has("grains.compacity") || !settings.has("grains.lattice")) return;
    settings.set("grains.compacity",
                 real_text(space_lattice(settings.text("grains.lattice")).densest()));
}

}  // namespace turbidite
