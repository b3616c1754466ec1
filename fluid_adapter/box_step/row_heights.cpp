// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_adapter/box_step/row_heights.hpp"

namespace turbidite {
namespace {

/// Row of the box whose height row j has: itself, or its image beyond a side.
int row_or_image(int j, int rows) {
    if (j < 0) return -1 - j;
    return j < rows ? j : 2 * rows - 1 - j;
}

}  // namespace

RowHeights::RowHeights(const AxisOperator& axis, const BoxRows& rows)
    : size_(axis.spacing), stretched_(axis.stretched()) {
    constexpr int beyond = BoxRows::beyond;
    for (int j = -beyond; j < rows.count() + beyond; ++j)
        sizes_.push_back(stretched_ ? axis.size(row_or_image(rows.first() + j, axis.cells))
                                    : size_);
}

bool RowHeights::equal_around(int j) const {
    return size(j - 2) == size(j - 1) && size(j - 1) == size(j) && size(j) == size(j + 1);
}

FaceBetweenRows RowHeights::face(int j) const {
    const double d = distance(j);
    return {d / distance(j - 1), d / distance(j + 1), 0.5 * size(j - 1) / d, 0.5 * size(j) / d};
}

}  // namespace turbidite
