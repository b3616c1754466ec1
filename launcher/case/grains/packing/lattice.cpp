// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/grains/packing/lattice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "coupler/rigid/vec3.hpp"
#include "launcher/case/grains/packing/neighbour_grid.hpp"
#include "launcher/case/grains/packing/random_numbers.hpp"

namespace turbidite {
namespace {

constexpr double clamping_distance = 1e-3;  // in compacity; the paper rounds to three digits

void fill_row(Packing& grains, double first, double y, const PackingRequest& request, double a) {
    // x from 1/2 (odd rows 1/2 + a/2) while x + 1/2 <= W
    for (int i = 0; first + i * a + 0.5 <= request.filled().width + fit_rounding; ++i)
        grains.push_back({.id = static_cast<GrainId>(grains.size()), .x = first + i * a, .y = y});
}

Packing fill_region(const PackingRequest& request, double a) {
    Packing grains;
    // Neighbours in adjacent rows touch: (a/2)^2 + height^2 = 1.
    const double height = std::sqrt(1.0 - a * a / 4.0);
    for (int k = 0; 0.5 + k * height + 0.5 <= request.filled().height + fit_rounding; ++k)
        fill_row(grains, k % 2 == 0 ? 0.5 : 0.5 + a / 2.0, 0.5 + k * height, request, a);
    return grains;
}

/// Along one axis: centres move from 1/2 + s to 1/2 + margin + s (1 + strain).
struct Stretch {
    double margin = 0.0;  ///< [D] from the lower side
    double strain = 0.0;
};

/// The stretch that `jitter` needs along an axis, or as much of it as `box` has room for beyond the
/// last centre; none along a periodic axis.
Stretch stretch_along(double jitter, double last, double box, bool periodic) {
    const double strain = std::min(2.0 * std::numbers::sqrt2 * jitter, compacity_for_jitter / 2.0);
    // A margin of j at either end, and what the stretch adds up to at the last centre.
    const double needed = 2.0 * jitter + strain * (last - 0.5);
    const double room = periodic ? 0.0 : std::max(0.0, box - 0.5 - last);
    const double part = std::min(1.0, room / needed);
    // With less room both shrink alike.
    return {part * jitter, part * strain};
}

/// Returns the ratio of the compacity to that before.
double make_room(Packing& grains, const PackingRequest& request) {
    double right = 0.5, top = 0.5;
    for (const PlacedGrain& grain : grains) {
        right = std::max(right, grain.x);
        top = std::max(top, grain.y);
    }
    const PackingBox& box = request.box;
    const Stretch x = stretch_along(request.jitter, right, box.width, box.periodic_x);
    const Stretch y = stretch_along(request.jitter, top, box.height, box.periodic_y);
    for (PlacedGrain& grain : grains) {
        grain.x += x.margin + x.strain * (grain.x - 0.5);
        grain.y += y.margin + y.strain * (grain.y - 0.5);
    }
    // The same grains on a larger area.
    return 1.0 / ((1.0 + x.strain) * (1.0 + y.strain));
}

bool inside(const PlacedGrain& grain, const PackingRegion& limits) {
    if (limits.cylinder) return limits.holds({grain.x, grain.y, grain.z}, grain.radius);
    return grain.x >= grain.radius && grain.x + grain.radius <= limits.width &&
           grain.y >= grain.radius && grain.y + grain.radius <= limits.height &&
           (limits.depth == 0.0 ||
            (grain.z >= grain.radius && grain.z + grain.radius <= limits.depth));
}

bool displace(NeighbourGrid& grid, std::size_t index, Vec3 way, const PackingRegion& limits) {
    constexpr int halvings = 5;
    for (int attempt = 0; attempt < halvings; ++attempt, way = way / 2.0) {
        PlacedGrain moved = grid.grains()[index];
        moved.x += way[0];
        moved.y += way[1];
        moved.z += way[2];
        if (!inside(moved, limits) || !grid.is_free(moved, 0.0, index)) continue;
        grid.move(index, moved.x, moved.y, moved.z);
        return true;
    }
    return false;
}

// A single note about the grains of the lattice, since stretch and displacements belong together.
void shake_lattice(PackingResult& result, const PackingRequest& request, double compacity) {
    const double left = make_room(result.grains, request);
    PackingResult shaken;
    shaken.grains = std::move(result.grains);
    apply_jitter(shaken, request);
    result.grains = std::move(shaken.grains);
    std::string note = fmt::format(
        "grains.jitter = {} stretched the lattice to a compacity of {:.4f}, so that grains can "
        "move",
        request.jitter, left * compacity);
    for (const std::string& more : shaken.notes) note += "; " + more;
    result.notes.push_back(std::move(note));
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
    // Rounding at phi = pi/4, where q = 1, must not make the root imaginary.
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
        result.notes.push_back(fmt::format(
            "grains.compacity = {} is clamped to {:.8f}, that of the {} possible lattice",
            request.compacity, used, used == high ? "densest" : "loosest"));
    result.grains = fill_region(request, lattice_spacing(used));
    if (result.grains.empty()) result.refusal = "The box is too small for a single grain.";
    if (request.jitter > 0.0 && !result.grains.empty()) shake_lattice(result, request, used);
    return result;
}

std::int64_t shake(Packing& grains, const PackingRequest& request, const PackingRegion& limits) {
    // A separate random stream, so that displacements do not repeat the numbers that placed the
    // grains.
    RandomNumbers random(request.seed ^ 0x9e3779b97f4a7c15u);
    NeighbourGrid grid(request.box, largest_radius(grains), 0.0, request.forms);
    for (const PlacedGrain& grain : grains) grid.insert(grain);
    std::int64_t moved = 0;
    for (std::size_t i = 0; i < grains.size(); ++i) {
        // Drawn for every grain, whether it has room or not: what one grain does changes no number
        // of the next.
        const double dx = random.uniform(-request.jitter, request.jitter);
        const double dy = random.uniform(-request.jitter, request.jitter);
        const double dz =
            request.box.in_space() ? random.uniform(-request.jitter, request.jitter) : 0.0;
        // One after the other, each against where the others are by now: no order of moves makes an
        // overlap.
        moved += displace(grid, i, {dx, dy, dz}, limits);
    }
    grains = grid.grains();
    return moved;
}

void apply_jitter(PackingResult& result, const PackingRequest& request) {
    if (request.jitter <= 0.0) return;
    const PackingRegion whole{request.box.width, request.box.height, request.box.depth};
    const bool round = request.region && request.region->cylinder;  // a wall may be around it
    const std::int64_t moved = shake(result.grains, request, round ? *request.region : whole);
    const auto all = static_cast<std::int64_t>(result.grains.size());
    if (moved < all)
        result.notes.push_back(fmt::format(
            "grains.jitter moved {} of {} grains; the others had no room to move", moved, all));
}

}  // namespace turbidite
