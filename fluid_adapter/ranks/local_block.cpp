// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/ranks/local_block.hpp"

#include <algorithm>

namespace turbidite {
namespace {

constexpr int unknown = -1, in_halo = -2;

}  // namespace

LocalBlock::LocalBlock(const CellGrid& grid, const std::vector<int>& own, int layers)
    : grid_(grid), own_count_(static_cast<int>(own.size())) {
    enclose(own, layers);
    index_.assign(static_cast<std::size_t>(width_[0]) * width_[1], unknown);
    const int columns = grid_.counts[0];
    for (int c = 0; c < own_count_; ++c) slot(own[c] % columns, own[c] / columns) = c;
    // A cell among eight own ones can be left out: one of them is nearer to all that it would mark.
    for (const int cell : own)
        if (!is_inside(cell)) mark_around(cell, layers);
    // Ascending, whatever the order of the own cells is.
    std::sort(halo_.begin(), halo_.end());
    count_rows();
}

/// Finds the rows numbered from row to row, beginning with the one that begins with cell 0.
void LocalBlock::count_rows() {
    const auto zero = std::find(index_.begin(), index_.end(), 0);
    const std::ptrdiff_t before = zero - index_.begin();
    // The table is left out only for rows of the block that own cells fill from end to end.
    if (zero == index_.end() || before % width_[0] != 0) return;
    int counted = 0;
    while (before + counted < static_cast<std::ptrdiff_t>(index_.size()) &&
           index_[before + counted] == counted)
        ++counted;
    first_counted_ = static_cast<int>(before / width_[0]);
    counted_rows_ = counted / width_[0];
}

void LocalBlock::enclose(const std::vector<int>& own, int layers) {
    const int columns = grid_.counts[0];
    for (int axis = 0; axis < 2; ++axis) {
        const int n = grid_.counts[axis];
        int lowest = n, highest = -1;
        for (const int cell : own) {
            const int i = axis == 0 ? cell % columns : cell / columns;
            lowest = std::min(lowest, i);
            highest = std::max(highest, i);
        }
        // A block that goes round a cyclic side continues with cell 0: CellTable adds `turn` to
        // offsets below zero.
        turn_[axis] = grid_.cyclic(axis) ? n : 0;
        int lower = lowest - layers, upper = highest + layers;
        if (!grid_.cyclic(axis)) lower = std::max(lower, 0), upper = std::min(upper, n - 1);
        // Once round at most: no cell has two places.
        if (own.empty() || upper - lower + 1 >= n) lower = 0, upper = n - 1;
        first_[axis] = grid_.wrapped(axis, lower);
        width_[axis] = own.empty() ? 0 : upper - lower + 1;
    }
}

/// Whether the cells around it, corners included, also belong to this rank.
bool LocalBlock::is_inside(int cell) const {
    const int i = cell % grid_.counts[0], j = cell / grid_.counts[0];
    for (int dj = -1; dj <= 1; ++dj)
        for (int di = -1; di <= 1; ++di) {
            const int column = grid_.wrapped(0, i + di), row = grid_.wrapped(1, j + dj);
            if (column >= 0 && row >= 0 && at(column, row) < 0) return false;
        }
    return true;
}

void LocalBlock::mark_around(int cell, int layers) {
    const int i = cell % grid_.counts[0], j = cell / grid_.counts[0];
    for (int dj = -layers; dj <= layers; ++dj)
        for (int di = -layers; di <= layers; ++di) {
            const int column = grid_.wrapped(0, i + di), row = grid_.wrapped(1, j + dj);
            if (column < 0 || row < 0) continue;
            int& index = slot(column, row);
            // Own cells, and those marked before
            if (index != unknown) continue;
            index = in_halo;
            halo_.push_back(column + grid_.counts[0] * row);
        }
}

void LocalBlock::number_halo(const std::vector<int>& order) {
    int next = own_count_;
    for (const int cell : order) slot(cell % grid_.counts[0], cell / grid_.counts[0]) = next++;
}

}  // namespace turbidite
