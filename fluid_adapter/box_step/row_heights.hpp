// SPDX-License-Identifier: GPL-2.0-or-later
//
// Heights of the rows of cells that a rank works on, and of two rows beyond either end: those of
// the rows there, or mirror images beyond a side. Rows may differ (a stretched axis); what is
// interpolated to the face between two rows for pressure and continuity is their mean,
//
//     S.u = (u_{-1} + u)/2,    (G p)_j = (p_{j+1} - p_{j-1})/(2 h_j)
//
// (OpenFOAM's `midPoint`), on rows of any heights. So G is minus the transpose of the divergence of
// S.u in the product weighted by volumes, as on equal rows; with the weights of distances it is
// not. The error is of second order where heights change smoothly: for a linear p it is
// (r - 1)^2/(4r) of the gradient, r the ratio of neighbouring heights. Valid C++17.
#pragma once

#include <vector>

#include "fluid_adapter/box_step/box_rows.hpp"

namespace turbidite {

/// The heights around the face between two rows, as convective_flux.hpp needs them.
struct FaceBetweenRows {
    double behind, ahead;  ///< d/d_behind, d/d_ahead: distances of centres across the face and next
    double low, high;      ///< from the centre of either cell to the face, over d
};

class RowHeights {
 public:
    RowHeights(const AxisOperator& axis, const BoxRows& rows);

    bool stretched() const { return stretched_; }

    /// h_j [m], -2 <= j < rows + 2.
    double size(int j) const { return sizes_[j + BoxRows::beyond]; }

    /// Between the centres of rows j - 1 and j [m].
    double distance(int j) const { return 0.5 * (size(j - 1) + size(j)); }

    /// h_j over that of the rows that are not stretched: the volume of a cell over theirs.
    double relative(int j) const { return size(j) / size_; }

    /// Whether the face below row j is as between equal rows, for stencils of two rows on each
    /// side.
    bool equal_around(int j) const;

    /// Of the face below row j.
    FaceBetweenRows face(int j) const;

    /// 1/d' - 1/d of the face below row j [1/m]: d' is the distance in the gradient that is
    /// interpolated to the face, 1/d' = (1/h_{j-1} + 1/h_j)/2. Zero between equal rows.
    double compact_excess(int j) const;

 private:
    double size_;
    bool stretched_;
    std::vector<double> sizes_;
};

}  // namespace turbidite
