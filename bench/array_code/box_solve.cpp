// SPDX-License-Identifier: GPL-2.0-or-later
#include "bench/array_code/box_solve.hpp"

#include <cmath>
#include <numbers>

namespace turbidite::array_code {

BoxSolve::BoxSolve(const Rows& rows, double spacing, Condition condition, double alpha, double beta,
                   double* first)
    : rows_(rows), pivots_(static_cast<std::size_t>(rows.nx) * rows.ny) {
    const bool neumann = condition == Condition::neumann;
    // Estimated plans, so that two runs perform the same arithmetic.
    there_ = fftw_plan_r2r_1d(rows.nx, first, first, neumann ? FFTW_REDFT10 : FFTW_RODFT10,
                              FFTW_ESTIMATE);
    back_ = fftw_plan_r2r_1d(rows.nx, first, first, neumann ? FFTW_REDFT01 : FFTW_RODFT01,
                             FFTW_ESTIMATE);
    const double beta_over_h2 = beta / (spacing * spacing);
    scale_ = 1.0 / (2.0 * rows.nx * beta_over_h2);
    factorise(condition, alpha, beta_over_h2);
}

BoxSolve::~BoxSolve() {
    fftw_destroy_plan(there_);
    fftw_destroy_plan(back_);
}

void BoxSolve::factorise(Condition condition, double alpha, double beta_over_h2) {
    const int nx = rows_.nx, ny = rows_.ny;
    const bool neumann = condition == Condition::neumann;
    const double at_wall = neumann ? 1.0 : 3.0;
    for (int k = 0; k < nx; ++k) {
        const double s = std::sin(0.5 * std::numbers::pi * (k + (neumann ? 0 : 1)) / nx);
        double pivot = 0.0;
        for (int j = 0; j < ny; ++j) {
            const double second = j == 0 || j == ny - 1 ? at_wall : 2.0;
            pivot = 1.0 / (alpha / beta_over_h2 + 4.0 * s * s + second - pivot);
            pivots_[static_cast<std::size_t>(j) * nx + k] = pivot;
        }
    }
    // The constant is free: its last pivot is infinite to rounding.
    if (neumann && alpha == 0.0) pivots_[static_cast<std::size_t>(ny - 1) * nx] = 0.0;
}

void BoxSolve::solve(double* first) const {
    const int nx = rows_.nx, ny = rows_.ny;
    const double* __restrict e = pivots_.data();
    fftw_execute_r2r(there_, first, first);
    for (int k = 0; k < nx; ++k) first[k] *= scale_ * e[k];
    for (int j = 1; j < ny; ++j) {
        e += nx;
        double* __restrict row = first + j * rows_.stride;
        const double* __restrict below = row - rows_.stride;
        fftw_execute_r2r(there_, row, row);
        for (int k = 0; k < nx; ++k) row[k] = (scale_ * row[k] + below[k]) * e[k];
    }
    for (int j = ny - 2; j >= 0; --j) {
        e -= nx;
        double* __restrict row = first + j * rows_.stride;
        double* __restrict above = row + rows_.stride;
        for (int k = 0; k < nx; ++k) row[k] += e[k] * above[k];
        fftw_execute_r2r(back_, above, above);
    }
    fftw_execute_r2r(back_, first, first);
}

}  // namespace turbidite::array_code
