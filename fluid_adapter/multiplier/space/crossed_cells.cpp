// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/space/crossed_cells.hpp"

#include <algorithm>
#include <cmath>

namespace turbidite {
namespace {

constexpr int along = 0, up = 1, across = 2;

/// Half the chord of a row at this square of a distance from the centre; 0 outside.
double half_chord(double radius, double square) {
    return std::sqrt(std::max(0.0, radius * radius - square));
}

}  // namespace

const std::vector<CrossedCell>& CrossedCells::find(const std::vector<ImmersedGrain>& grains) {
    crossed_.clear();
    find_crossing(grains);
    for (const std::size_t g : crossing_) find_rows(static_cast<int>(g), grains[g]);
    return crossed_;
}

void CrossedCells::find_crossing(const std::vector<ImmersedGrain>& grains) {
    crossing_.clear();
    for (std::size_t g = 0; g < grains.size(); ++g)
        if (crosses(grains[g])) crossing_.push_back(g);
    std::sort(crossing_.begin(), crossing_.end(),
              [&](std::size_t a, std::size_t b) { return grains[a].id < grains[b].id; });
}

bool CrossedCells::crosses(const ImmersedGrain& body) const {
    // The square of a length that has one may be zero: nothing has moved.
    if (body.wall || !(body.moved.squaredNorm() > 0.0)) return false;
    // Twice its reach fits into the box, so that no cell is met on two ways.
    for (const int axis : {along, up, across})
        if (grid().cyclic(axis) && grid().length(axis) < 2.0 * (body.radius + body.moved.norm()) +
                                                             4.0 * grid().spacing[axis])
            return false;
    return true;
}

/// This rank's layers and those beside them.
bool CrossedCells::known(int layer) const {
    for (const int beside : {0, -1, 1}) {
        const int at = grid().wrapped(up, layer + beside);
        if (at >= 0 && cells_.owns(at)) return true;
    }
    return false;
}

void CrossedCells::find_rows(int grain, const ImmersedGrain& sphere) {
    // Of both places
    const double reach = sphere.radius + sphere.moved.norm();
    for_rows_within(grid(), sphere.position, reach, [&](int j, int k, double y, double z) {
        if (known(j)) find_row({grain, j, k, y, z}, sphere);
    });
}

void CrossedCells::find_row(const Row& row, const ImmersedGrain& sphere) {
    const Eigen::Vector3d& moved = sphere.moved;
    const double old_y = row.y + moved.y(), old_z = row.z + moved.z();
    const double now = half_chord(sphere.radius, row.y * row.y + row.z * row.z),
                 before = half_chord(sphere.radius, old_y * old_y + old_z * old_z);
    if (now == 0.0 && before == 0.0) return;
    const double at = sphere.position.x();
    const int low = grid().layer(along, at + std::min(-now, -moved.x() - before)),
              high = grid().layer(along, at + std::max(now, -moved.x() + before));
    // What both places cover, but for a cell at either end, lies between and need not be asked.
    const int first = grid().layer(along, at + std::max(-now, -moved.x() - before)) + 2,
              last = grid().layer(along, at + std::min(now, -moved.x() + before)) - 2;
    const bool both = now > 0.0 && before > 0.0;
    for (int i = low; i <= high; ++i) {
        if (both && i == first && last > first) i = last;
        take(row, sphere, i);
    }
}

void CrossedCells::take(const Row& row, const ImmersedGrain& sphere, int i) {
    const int column = grid().wrapped(along, i);
    if (column < 0) return;
    const Eigen::Vector3d arm(grid().centre(along, i) - sphere.position.x(), row.y, row.z);
    const bool inside = arm.squaredNorm() < sphere.radius * sphere.radius;
    if (inside == was_inside(sphere, arm)) return;
    const CellPlace place{column, row.j, row.k};
    if (owners_[place] == (inside ? row.grain : CellOwners::none))
        crossed_.push_back({row.grain, place, arm, inside});
}

}  // namespace turbidite
