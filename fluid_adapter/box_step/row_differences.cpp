// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_adapter/box_step/row_differences.hpp"

#include "fluid_adapter/box_step/row_work.hpp"

namespace turbidite {

void RowDifferences::laplacian(int j, double share, RowReader& u, double* out) const {
    const double* below = u.row(j - 1);
    const double* here = u.row(j);
    const double* above = u.row(j + 1);
    laplacian_row(nx, share / (hx * hx), heights.over_volumes(j, share), below, here, above, out);
}

void RowDifferences::correct_across(int j, double step, RowReader& p, const double* in,
                                    double* out) const {
    const double* below = p.row(j - 1);
    const double* here = p.row(j);
    const double* above = p.row(j + 1);
    turbidite::correct_across(nx, heights.over_distances(j, 0.5 * step), below, here, above, in,
                              out);
}

}  // namespace turbidite
