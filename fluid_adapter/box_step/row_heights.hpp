// SPDX-License-Identifier: GPL-2.0-or-later
//
// Heights h_j of the rows of cells that a rank works on, and of two rows beyond either end: those
// of the rows there, or mirror images beyond a side. With d the distance of two centres,
// interpolation to the face between two rows and the gradient of p along y are
//
//     S.u = (h_{-1} u_{-1} + h u)/(h_{-1} + h)
//     (G p)_j = ((p_j - p_{j-1})/d + (p_{j+1} - p_j)/d_{+1})/2
//
// G is OpenFOAM's `Gauss linear`, exact for a linear p: what hydrostatic pressure balances stays at
// rest. S weighs by volumes (`reverseLinear`) so that G is minus the transpose of the divergence of
// S.u in the product weighted by volumes, which conjugate gradients with rigid grains need; it is
// exact for a uniform u. On equal rows both are the central ones. Valid C++17.
#pragma once

#include <vector>

#include "fluid_adapter/box_step/box_rows.hpp"
#include "fluid_adapter/box_step/row_work.hpp"
#include "fluid_adapter/box_step/transport/convective_flux.hpp"

namespace turbidite {

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

    /// The places of centres around the face below row j.
    FacePlace face(int j) const;

    /// Of S at the face below row j: volumes over their sum.
    RowShares volume_shares(int j) const;

    /// share/d below and above row j.
    RowShares over_distances(int j, double share) const {
        return {share / distance(j), share / distance(j + 1), equal_to_both(j)};
    }

    /// share/(h_j d) below and above row j.
    RowShares over_volumes(int j, double share) const {
        return {share / (size(j) * distance(j)), share / (size(j) * distance(j + 1)),
                equal_to_both(j)};
    }

    /// share (S.v_{+1} - S.v)/h_j, from the rows below, here and above.
    ThreeRows central_difference(int j, double share) const;

 private:
    bool equal_beside(int j) const { return size(j - 1) == size(j); }
    bool equal_to_both(int j) const { return equal_beside(j) && equal_beside(j + 1); }

    double size_;
    bool stretched_;
    std::vector<double> sizes_;
};

}  // namespace turbidite
