// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_adapter/box_step/row_differences.hpp"

#include "fluid_adapter/box_step/row_work.hpp"

namespace turbidite {

void RowDifferences::laplacian(int j, double share, RowReader& u, double* out) const {
    const double* below = u.row(j - 1);
    const double* here = u.row(j);
    const double* above = u.row(j + 1);
    const double x = share / (hx * hx), h = heights.size(j);
    if (heights.equal_to_both(j))
        return laplacian_row(nx, x, share / (h * h), below, here, above, out);
    const RowShares y{share / (h * heights.distance(j)), share / (h * heights.distance(j + 1))};
    laplacian_row(nx, x, y, below, here, above, out);
}

void RowDifferences::correct_across(int j, double step, RowReader& p, const double* in,
                                    double* out) const {
    const double* below = p.row(j - 1);
    const double* here = p.row(j);
    const double* above = p.row(j + 1);
    if (heights.equal_to_both(j))
        return correct(nx, 0.5 * step / heights.size(j), below, above, in, out);
    const RowShares y{0.5 * step / heights.distance(j), 0.5 * step / heights.distance(j + 1)};
    correct(nx, y, below, here, above, in, out);
}

}  // namespace turbidite
