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

FacePlace RowHeights::face(int j) const {
    // The four rows around the face, by their heights: distances of rows whose heights differ in
    // the last bit may be equal, and the short form is not theirs.
    if (equal_to_both(j - 1) && equal_to_both(j)) return {};
    const double d = distance(j);
    return {d / distance(j - 1), d / distance(j + 1), 0.5 * size(j - 1) / d, 0.5 * size(j) / d,
            false};
}

RowShares RowHeights::volume_shares(int j) const {
    if (equal_beside(j)) return halves;
    const double both = size(j - 1) + size(j);
    return {size(j - 1) / both, size(j) / both, false};
}

ThreeRows RowHeights::central_difference(int j, double share) const {
    // share (S.v_{+1} - S.v)/h_j, S.v at the faces above and below row j
    const double h = size(j), y = 0.5 * share / h;
    if (equal_to_both(j)) return {-y, 0.0, y, true};
    // S.v = (h_{-1} v_{-1} + h v)/(2d)
    const double low = y / distance(j), high = y / distance(j + 1);
    return {-low * size(j - 1), (high - low) * h, high * size(j + 1), false};
}

}  // namespace turbidite
