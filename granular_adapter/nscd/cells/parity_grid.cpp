// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/cells/parity_grid.hpp"

#include <algorithm>
#include <cmath>

namespace turbidite::nscd {
namespace {

// Edge of a cell over the largest distance of centres in contact. More than 2, so that cells of one
// parity share no body; larger cells have fewer contacts that wait for another parity.
constexpr double edge_over_distance = 5.0;

// Radius over the median from which a body is large.
constexpr double large_over_median = 4.0;

// Indices are below 2^20, but the place of the last one (place_along) is 2^20.
constexpr int axis_bits = 21;  // three axes in 63 bits
constexpr std::int64_t cells_per_axis = std::int64_t{1} << 20;

// Keeps every centre within the cells of an axis.
constexpr double largest_index = 5e5;

// Cells that a body may have contacts in are looked for a little farther than d, so that rounding
// misses none.
constexpr double margin = 1.001;

double median(std::vector<double> values) {
    // Of an even number of values the upper one of the two in the middle: a value that occurs,
    // which does not depend on the order of the bodies.
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Place of cell i in 0, 2, 1, 4, 3, 6, 5, ...
std::uint64_t place_along(std::uint64_t i) {
    return i % 2 == 1 ? i + 1 : std::max<std::uint64_t>(i, 1) - 1;
}

/// As many cells of at least this edge as fit, an even number; or one.
std::int64_t even_count(double length, double edge) {
    const auto count = static_cast<std::int64_t>(
        std::min(std::floor(length / edge), static_cast<double>(cells_per_axis)));
    // Along a periodic axis the first and the last cell are neighbours: only with an even number do
    // they have different parities. A single cell has no neighbour.
    return std::max<std::int64_t>(count - count % 2, 1);
}

}  // namespace

CellSizes sizes_of(const std::vector<double>& radii) {
    CellSizes sizes;
    if (radii.empty()) return sizes;
    sizes.large = large_over_median * median(radii);
    sizes.smallest = radii.front();
    for (const double radius : radii) {
        sizes.smallest = std::min(sizes.smallest, radius);
        if (radius <= sizes.large) sizes.largest = std::max(sizes.largest, radius);
    }
    return sizes;
}

double span_of(const std::vector<Vec3>& centres, const Vec3& origin) {
    double farthest = 0.0;
    for (const Vec3& x : centres)
        for (std::size_t axis = 0; axis < 3; ++axis)
            farthest = std::max(farthest, std::abs(x[axis] - origin[axis]));
    return farthest;
}

CellSizes cell_sizes(const Bodies& bodies, const PeriodicBox& box) {
    CellSizes sizes = sizes_of(bodies.radius);
    sizes.span = span_of(bodies.position, box.lower);
    return sizes;
}

std::uint64_t ParityGrid::Cell::place() const {
    if (large) return ~std::uint64_t{0};
    return place_along(x) << (2 * axis_bits) | place_along(z) << axis_bits | place_along(y);
}

std::uint64_t ParityGrid::Axis::index(double x) const {
    const auto i = static_cast<std::int64_t>(std::floor((x - lower) / edge));
    // Without an end, indices begin in the middle of their range, so that they are positive on both
    // sides of `lower`. The middle is even: parities are the same as counted from `lower`.
    const std::int64_t first = count > 0 ? 0 : cells_per_axis / 2;
    const std::int64_t last = (count > 0 ? count : cells_per_axis) - 1;
    return static_cast<std::uint64_t>(std::clamp<std::int64_t>(i + first, 0, last));
}

double ParityGrid::Axis::middle(std::uint64_t index) const {
    const std::int64_t first = count > 0 ? 0 : cells_per_axis / 2;
    return lower + edge * (static_cast<double>(static_cast<std::int64_t>(index) - first) + 0.5);
}

ParityGrid::ParityGrid(const CellSizes& sizes, const PeriodicBox& box, double reach, double share)
    : sizes_(sizes), box_(box), reach_(reach), share_(share) {
    const double distance = 2.0 * (1.0 + share) * sizes.largest + reach;
    wide_ = margin * distance;
    const double least = std::max(edge_over_distance * distance, sizes.span / largest_index);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        axes_[axis] = {box.lower[axis], least > 0.0 ? least : 1.0, 0};
        if (!box.repeats(static_cast<int>(axis))) continue;
        axes_[axis].count = even_count(box.length[axis], least);
        axes_[axis].edge = box.length[axis] / static_cast<double>(axes_[axis].count);
    }
}

ParityGrid::Cell ParityGrid::cell(const Vec3& centre) const {
    return {axes_[0].index(centre[0]), axes_[1].index(centre[1]), axes_[2].index(centre[2])};
}

Vec3 ParityGrid::centre(const Cell& cell) const {
    return {axes_[0].middle(cell.x), axes_[1].middle(cell.y), axes_[2].middle(cell.z)};
}

}  // namespace turbidite::nscd
