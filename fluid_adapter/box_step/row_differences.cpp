// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_adapter/box_step/row_differences.hpp"

#include <tuple>

#include "fluid_adapter/box_step/row_work.hpp"

namespace turbidite {

void RowDifferences::laplacian(int j, int k, double share, RowReader& u, double* out) const {
    const auto [nx, hx, hz, heights] = std::tie(layers.nx, layers.hx, layers.hz, layers.heights);
    const double* below = u.row(j - 1, k);
    const double* here = u.row(j, k);
    const double* above = u.row(j + 1, k);
    laplacian_row(nx, share / (hx * hx), heights.over_volumes(j, share), below, here, above, out);
    if (layers.in_space())
        add_second_difference(nx, share / (hz * hz), u.row(j, k - 1), here, u.row(j, k + 1), out);
}

void RowDifferences::correct(int axis, int j, int k, double step, RowReader& p, const double* in,
                             double* out) const {
    const int nx = layers.nx;
    const double* below = p.row(j - 1, k);
    const double* here = p.row(j, k);
    // in - step (p_{+1} - p_{-1})/(2h); along y the mean of both slopes (row_heights.hpp)
    if (axis == 0)
        return turbidite::correct(nx, 0.5 * step / layers.hx, here - 1, here + 1, in, out);
    if (axis == 2)
        return turbidite::correct(nx, 0.5 * step / layers.hz, p.row(j, k - 1), p.row(j, k + 1), in,
                                  out);
    const double* above = p.row(j + 1, k);
    correct_across(nx, layers.heights.over_distances(j, 0.5 * step), below, here, above, in, out);
}

}  // namespace turbidite
