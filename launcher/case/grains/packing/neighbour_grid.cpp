// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/grains/packing/neighbour_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "launcher/case/grains/grain_forms.hpp"

namespace turbidite {
namespace {

// Beyond this number a finer grid gains nothing, and a huge empty box would fill the memory.
constexpr double most_cells_per_side = 4096.0;
constexpr double most_cells_per_edge = 200.0;  // in space

std::size_t cells_along(double length, double cell, bool in_space) {
    return static_cast<std::size_t>(std::clamp(
        std::floor(length / cell), 1.0, in_space ? most_cells_per_edge : most_cells_per_side));
}

std::size_t cell_of(double place, double length, std::size_t count) {
    // A centre on the upper side, or beyond one, belongs to the cell beside it.
    const double cell = std::floor(place / length * static_cast<double>(count));
    return static_cast<std::size_t>(std::clamp(cell, 0.0, static_cast<double>(count - 1)));
}

/// A cell and those beside it along one direction, each once.
class CellsAround {
 public:
    CellsAround(std::size_t centre, std::size_t count, bool periodic) {
        add(centre);
        if (centre > 0 || periodic) add((centre + count - 1) % count);
        if (centre + 1 < count || periodic) add((centre + 1) % count);
    }
    const std::size_t* begin() const { return cells_.data(); }
    const std::size_t* end() const { return cells_.data() + size_; }

 private:
    void add(std::size_t cell) {
        // With one or two cells along a cyclic direction the neighbours on both sides are the same.
        if (std::find(begin(), end(), cell) == end()) cells_[size_++] = cell;
    }

    std::array<std::size_t, 3> cells_{};
    std::size_t size_ = 0;
};

double nearest_image(double distance, double length, bool periodic) {
    return periodic ? distance - length * std::round(distance / length) : distance;
}

}  // namespace

NeighbourGrid::NeighbourGrid(const PackingBox& box, double largest_radius, double reach,
                             const GrainForms* forms)
    : box_(box), forms_(forms), cell_(2.0 * largest_radius + reach) {
    // Rounded down: cells are at least as wide as the largest distance that matters.
    columns_ = cells_along(box.width, cell_, box.in_space());
    rows_ = cells_along(box.height, cell_, box.in_space());
    if (box.in_space()) layers_ = cells_along(box.depth, cell_, true);
    cells_.resize(columns_ * rows_ * layers_);
}

std::size_t NeighbourGrid::column(double x) const {
    return cell_of(x, box_.width, columns_);
}
std::size_t NeighbourGrid::row(double y) const {
    return cell_of(y, box_.height, rows_);
}

std::size_t NeighbourGrid::layer(double z) const {
    return layers_ == 1 ? 0 : cell_of(z, box_.depth, layers_);
}

std::vector<std::size_t>& NeighbourGrid::cell_at(const PlacedGrain& grain) {
    return cells_[(layer(grain.z) * rows_ + row(grain.y)) * columns_ + column(grain.x)];
}

void NeighbourGrid::insert(const PlacedGrain& grain) {
    cell_at(grain).push_back(grains_.size());
    grains_.push_back(grain);
}

void NeighbourGrid::move(std::size_t index, double x, double y, double z) {
    PlacedGrain& grain = grains_[index];
    auto& old_cell = cell_at(grain);
    old_cell.erase(std::find(old_cell.begin(), old_cell.end(), index));
    grain.x = x;
    grain.y = y;
    grain.z = z;
    cell_at(grain).push_back(index);
}

Vec3 NeighbourGrid::distance(const PlacedGrain& one, const PlacedGrain& other) const {
    return {nearest_image(other.x - one.x, box_.width, box_.periodic_x),
            nearest_image(other.y - one.y, box_.height, box_.periodic_y),
            box_.in_space() ? nearest_image(other.z - one.z, box_.depth, box_.periodic_z) : 0.0};
}

double NeighbourGrid::circle_gap(const PlacedGrain& one, const PlacedGrain& other) const {
    const auto [dx, dy, dz] = distance(one, other);
    const double length = box_.in_space() ? std::hypot(dx, dy, dz) : std::hypot(dx, dy);
    return length - one.radius - other.radius;
}

bool NeighbourGrid::is_closer(const PlacedGrain& one, const PlacedGrain& other,
                              double least) const {
    // Squares decide but within rounding of the limit: hypot takes most of the time of a packing.
    constexpr double margin = 1.0 + 1e-9;
    const auto [dx, dy, dz] = distance(one, other);
    const double reach = least + one.radius + other.radius;
    if (dx * dx + dy * dy + dz * dz > margin * reach * reach) return false;
    return circle_gap(one, other) < least && gap(one, other) < least;
}

double NeighbourGrid::gap(const PlacedGrain& one, const PlacedGrain& other) const {
    if (forms_ == nullptr || box_.in_space()) return circle_gap(one, other);  // all are spheres
    // Outlines know no period: the nearest image is placed instead.
    PlacedGrain image = other;
    image.x = one.x + nearest_image(other.x - one.x, box_.width, box_.periodic_x);
    image.y = one.y + nearest_image(other.y - one.y, box_.height, box_.periodic_y);
    return surface_gap(placed_outline(one, *forms_), placed_outline(image, *forms_));
}

template <class Predicate>
bool NeighbourGrid::any_near(double x, double y, double z, const Predicate& holds) const {
    for (const std::size_t l : CellsAround(layer(z), layers_, box_.periodic_z))
        for (const std::size_t r : CellsAround(row(y), rows_, box_.periodic_y))
            for (const std::size_t c : CellsAround(column(x), columns_, box_.periodic_x)) {
                const auto& cell = cells_[(l * rows_ + r) * columns_ + c];
                if (std::any_of(cell.begin(), cell.end(), holds)) return true;
            }
    return false;
}

std::vector<std::size_t> NeighbourGrid::near(double x, double y, double z) const {
    std::vector<std::size_t> found;
    any_near(x, y, z, [&](std::size_t index) {
        found.push_back(index);
        return false;
    });
    std::sort(found.begin(), found.end());
    return found;
}

bool NeighbourGrid::is_free(const PlacedGrain& grain, double smallest_gap,
                            std::size_t except) const {
    // Grains of a lattice touch to rounding and are free all the same.
    const double least = smallest_gap - touching_tolerance;
    return !any_near(grain.x, grain.y, grain.z, [&](std::size_t index) {
        return index != except && is_closer(grain, grains_[index], least);
    });
}

}  // namespace turbidite
