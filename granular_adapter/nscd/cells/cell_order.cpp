// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/cells/cell_order.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace turbidite::nscd {
namespace {

// Edge of a cell over the largest distance of centres in contact. More than 2, so that cells of one
// parity share no body; larger cells have fewer contacts that wait for another parity.
constexpr double edge_over_distance = 5.0;

// Radius over the median from which a body is large.
constexpr double large_over_median = 4.0;

constexpr int axis_bits = 21;  // three axes in 63 bits
constexpr std::int64_t cells_per_axis = std::int64_t{1} << 20;

// Keeps every centre within the cells of an axis.
constexpr double largest_index = 5e5;

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// The largest of these radii that is not above `most`.
double largest_up_to(double most, const std::vector<double>& radii) {
    double largest = 0.0;
    for (const double radius : radii)
        if (radius <= most) largest = std::max(largest, radius);
    return largest;
}

/// The largest distance of a centre from `origin` along any axis.
double span(const std::vector<Vec3>& centres, const Vec3& origin) {
    double farthest = 0.0;
    for (const Vec3& x : centres)
        for (std::size_t axis = 0; axis < 3; ++axis)
            farthest = std::max(farthest, std::abs(x[axis] - origin[axis]));
    return farthest;
}

/// Place of cell i in 0, 2, 1, 4, 3, 6, 5, ...
std::uint64_t place_along(std::uint64_t i) {
    return i % 2 == 1 ? i + 1 : std::max<std::uint64_t>(i, 1) - 1;
}

std::uint64_t place_of(const CellOrder::Cell& cell) {
    if (cell.large) return ~std::uint64_t{0};
    return place_along(cell.x) << (2 * axis_bits) | place_along(cell.z) << axis_bits |
           place_along(cell.y);
}

/// As many cells of at least this edge as fit, an even number; or one.
std::int64_t even_count(double length, double edge) {
    const auto count = static_cast<std::int64_t>(
        std::min(std::floor(length / edge), static_cast<double>(cells_per_axis)));
    return std::max<std::int64_t>(count - count % 2, 1);
}

}  // namespace

std::uint64_t CellOrder::Axis::index(double x) const {
    const auto i = static_cast<std::int64_t>(std::floor((x - lower) / edge));
    const std::int64_t first = count > 0 ? 0 : cells_per_axis / 2;
    const std::int64_t last = (count > 0 ? count : cells_per_axis) - 1;
    return static_cast<std::uint64_t>(std::clamp<std::int64_t>(i + first, 0, last));
}

CellOrder::CellOrder(const CellScene& scene) : scene_(scene) {
    const Bodies& bodies = scene.bodies;
    const double weight = norm(scene.gravity);
    layered_ = weight > 0.0 && scene.band > 0.0;
    if (layered_) down_ = (1.0 / weight) * scene.gravity;
    if (bodies.size() == 0) return;
    large_ = large_over_median * median(bodies.radius);
    const double distance =
        2.0 * (1.0 + scene.share) * largest_up_to(large_, bodies.radius) + scene.reach;
    lay_axes(std::max(edge_over_distance * distance,
                      span(bodies.position, scene.box.lower) / largest_index));
}

void CellOrder::lay_axes(double least_edge) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        axes_[axis] = {scene_.box.lower[axis], least_edge, 0};
        if (!scene_.box.repeats(static_cast<int>(axis))) continue;
        axes_[axis].count = even_count(scene_.box.length[axis], least_edge);
        axes_[axis].edge = scene_.box.length[axis] / static_cast<double>(axes_[axis].count);
    }
}

bool CellOrder::is_large(std::int32_t body) const {
    return body >= 0 && scene_.bodies.radius[static_cast<std::size_t>(body)] > large_;
}

CellOrder::Cell CellOrder::cell(const ContactPoint& point) const {
    if (is_large(point.a) || is_large(point.b)) return {0, 0, 0, true};
    const std::int32_t owner = point.a >= 0 ? point.a : point.b;  // a has the lower id
    const Vec3& centre = scene_.bodies.position[static_cast<std::size_t>(owner)];
    return {axes_[0].index(centre[0]), axes_[1].index(centre[1]), axes_[2].index(centre[2])};
}

double CellOrder::layer(const ContactPoint& point) const {
    if (!layered_) return 0.0;
    const Vec3& centre = scene_.bodies.position[static_cast<std::size_t>(point.b)];
    return std::floor((dot(down_, centre) + dot(down_, point.arm_b)) / scene_.band);
}

void CellOrder::add(const ContactPoint& point) {
    const auto id = [this](std::int32_t body) {
        return scene_.bodies.id[static_cast<std::size_t>(body)];
    };
    const GrainId first =
        point.wall < 0 ? id(point.a) : scene_.walls[static_cast<std::size_t>(point.wall)].key;
    places_.push_back({place_of(cell(point)), layer(point), first, id(point.b),
                       point.wall >= 0 ? 1 : 0, point.feature,
                       static_cast<std::int32_t>(places_.size())});
}

std::vector<std::int32_t> CellOrder::take() {
    std::sort(places_.begin(), places_.end(), [](const Place& p, const Place& q) {
        return std::tie(p.cell, p.layer, p.wall, p.first, p.second, p.feature) <
               std::tie(q.cell, q.layer, q.wall, q.first, q.second, q.feature);
    });
    std::vector<std::int32_t> order;
    order.reserve(places_.size());
    for (const Place& place : places_) order.push_back(place.point);
    places_.clear();
    return order;
}

}  // namespace turbidite::nscd
