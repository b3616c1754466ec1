// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Minus the Laplacian of a small grid as a dense matrix, assembled face by face as in a
// finite-volume code: the flux through a face is the difference of the two adjacent values over
// their distance; a boundary face has one adjacent value, at half the distance.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "fluid_adapter/linear_solvers/separable_solve.hpp"

namespace turbidite {

using Ends = std::array<End, 2>;

inline const std::vector<Ends>& all_ends() {
    static const std::vector<Ends> list = {{End::neumann, End::neumann},
                                           {End::dirichlet, End::dirichlet},
                                           {End::neumann, End::dirichlet},
                                           {End::dirichlet, End::neumann},
                                           {End::periodic, End::periodic}};
    return list;
}

inline AxisOperator axis_of(int cells, double spacing, const Ends& ends) {
    return {cells, spacing, ends[0], ends[1]};
}

inline Eigen::MatrixXd dense_axis(const AxisOperator& axis) {
    const int n = axis.cells;
    const auto h = [&](int j) { return axis.sizes.empty() ? axis.spacing : axis.sizes[j]; };
    Eigen::MatrixXd L = Eigen::MatrixXd::Zero(n, n);
    const auto face_between = [&](int a, int b) {
        const double apart = (h(a) + h(b)) / 2.0;
        for (const auto& [row, other] : {std::array{a, b}, std::array{b, a}}) {
            L(row, row) += 1.0 / apart / h(row);  // difference / distance, per length of the cell
            L(row, other) -= 1.0 / apart / h(row);
        }
    };
    for (int j = 0; j + 1 < n; ++j) face_between(j, j + 1);
    if (axis.lower == End::periodic) face_between(n - 1, 0);
    if (axis.lower == End::dirichlet) L(0, 0) += 1.0 / (h(0) / 2.0) / h(0);
    if (axis.upper == End::dirichlet) L(n - 1, n - 1) += 1.0 / (h(n - 1) / 2.0) / h(n - 1);
    return L;
}

/// Values numbered i + nx (k + nz j).
inline Eigen::MatrixXd dense_grid(const SeparableOperator& grid) {
    const int nx = grid.x.cells, ny = grid.y.cells, nz = grid.z.cells;
    const Eigen::MatrixXd Lx = dense_axis(grid.x), Ly = dense_axis(grid.y);
    const Eigen::MatrixXd Lz = nz > 1 ? dense_axis(grid.z) : Eigen::MatrixXd::Zero(1, 1);
    Eigen::MatrixXd L = Eigen::MatrixXd::Zero(grid.layer() * ny, grid.layer() * ny);
    const auto at = [&](int i, int j, int k) { return i + nx * (k + nz * j); };
    for (int j = 0; j < ny; ++j)
        for (int k = 0; k < nz; ++k)
            for (int i = 0; i < nx; ++i) {
                for (int m = 0; m < nx; ++m) L(at(i, j, k), at(m, j, k)) += Lx(i, m);
                for (int m = 0; m < ny; ++m) L(at(i, j, k), at(i, m, k)) += Ly(j, m);
                for (int m = 0; m < nz; ++m) L(at(i, j, k), at(i, j, m)) += Lz(k, m);
            }
    return L;
}

}  // namespace turbidite
