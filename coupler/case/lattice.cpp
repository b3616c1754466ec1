// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/case/lattice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "coupler/case/neighbour_grid.hpp"
#include "coupler/case/random_numbers.hpp"

namespace turbidite {
namespace {

constexpr double clamping_distance = 1e-3;  // in compacity; the paper rounds to three digits
constexpr double rounding = 1e-9;           // [D] lets an exact fit survive rounding

void fill_row(Packing& grains, double first, double y, const PackingRequest& request, double a) {
    for (int i = 0; first + i * a + 0.5 <= request.box.width + rounding; ++i)
        grains.push_back({.id = static_cast<GrainId>(grains.size()), .x = first + i * a, .y = y});
}

Packing fill_box(const PackingRequest& request, double a) {
    Packing grains;
    const double height = std::sqrt(1.0 - a * a / 4.0);
    for (int k = 0; 0.5 + k * height + 0.5 <= request.box.height + rounding; ++k)
        fill_row(grains, k % 2 == 0 ? 0.5 : 0.5 + a / 2.0, 0.5 + k * height, request, a);
    return grains;
}

bool inside(const PlacedGrain& grain, const PackingBox& box) {
    return grain.x >= grain.radius && grain.x + grain.radius <= box.width &&
           grain.y >= grain.radius && grain.y + grain.radius <= box.height;
}

bool displace(NeighbourGrid& grid, std::size_t index, double dx, double dy, const PackingBox& box) {
    constexpr int halvings = 5;
    for (int attempt = 0; attempt < halvings; ++attempt, dx /= 2.0, dy /= 2.0) {
        PlacedGrain moved = grid.grains()[index];
        moved.x += dx;
        moved.y += dy;
        if (!inside(moved, box) || !grid.is_free(moved, 0.0, index)) continue;
        grid.move(index, moved.x, moved.y);
        return true;
    }
    return false;
}

}  // namespace

double loosest_compacity() {
    return std::numbers::pi / 4.0;
}
double densest_compacity() {
    return std::numbers::pi / (2.0 * std::numbers::sqrt3);
}

double lattice_spacing(double compacity) {
    // a^2 (1 - a^2/4) = q^2 with q = (pi/4)/phi; the root between 1 and sqrt 2 is the smaller one.
    const double q = std::numbers::pi / 4.0 / compacity;
    const double a_squared = 2.0 * (1.0 - std::sqrt(std::max(0.0, 1.0 - q * q)));
    return std::clamp(std::sqrt(a_squared), 1.0, std::numbers::sqrt2);
}

PackingResult lattice_packing(const PackingRequest& request) {
    PackingResult result;
    const double low = loosest_compacity();
    const double high = densest_compacity();
    const double used = std::clamp(request.compacity, low, high);
    if (std::abs(used - request.compacity) > clamping_distance) {
        result.refusal = fmt::format(
            "The lattice has compacities from {:.4f} (pi/4) to {:.4f} (pi/(2 sqrt 3)). "
            "Choose one of these, or grains.generator: random for looser packings.",
            low, high);
        return result;
    }
    if (used != request.compacity)
        result.notes.push_back(
            fmt::format("grains.compacity = {} is clamped to {:.6f}, the {} the "
                        "lattice can be",
                        request.compacity, used, used == high ? "densest" : "loosest"));
    result.grains = fill_box(request, lattice_spacing(used));
    if (result.grains.empty()) result.refusal = "The box is too small for a single grain.";
    apply_jitter(result, request);
    return result;
}

std::int64_t shake(Packing& grains, const PackingRequest& request) {
    // A stream of its own, so that displacements do not repeat the numbers that placed the grains.
    RandomNumbers random(request.seed ^ 0x9e3779b97f4a7c15u);
    NeighbourGrid grid(request.box, 0.5, 0.0);
    for (const PlacedGrain& grain : grains) grid.insert(grain);
    std::int64_t moved = 0;
    for (std::size_t i = 0; i < grains.size(); ++i) {
        const double dx = random.uniform(-request.jitter, request.jitter);
        const double dy = random.uniform(-request.jitter, request.jitter);
        moved += displace(grid, i, dx, dy, request.box);
    }
    grains = grid.grains();
    return moved;
}

void apply_jitter(PackingResult& result, const PackingRequest& request) {
    if (request.jitter <= 0.0) return;
    const std::int64_t moved = shake(result.grains, request);
    const auto all = static_cast<std::int64_t>(result.grains.size());
    if (moved < all)
        result.notes.push_back(fmt::format(
            "grains.jitter moved {} of {} grains, the others had no room to move", moved, all));
}

}  // namespace turbidite
