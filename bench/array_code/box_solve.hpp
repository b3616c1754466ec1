// SPDX-License-Identifier: GPL-2.0-or-later
//
// (alpha - beta laplacian) x = f on nx x ny square cells with the same condition on all four sides:
// DCT or DST of the rows, elimination along y, and the inverse transform. A row is the cells of one
// y. Each row is transformed when the elimination needs it, so that it is read from memory once on
// the way up and once on the way down.
#pragma once

#include <fftw3.h>

#include <cstddef>
#include <vector>

namespace turbidite::array_code {

/// Condition at the faces of the box: zero gradient, or zero value.
enum class Condition { neumann, dirichlet };

/// Location of the rows of an array: row j starts at first + j stride, 16-byte aligned.
struct Rows {
    int nx = 0, ny = 0;
    std::ptrdiff_t stride = 0;
};

class BoxSolve {
 public:
    /// alpha [1], beta [m2]; spacing of the cells [m]. `first` is overwritten while plans are made.
    BoxSolve(const Rows& rows, double spacing, Condition condition, double alpha, double beta,
             double* first);
    ~BoxSolve();
    BoxSolve(const BoxSolve&) = delete;
    BoxSolve& operator=(const BoxSolve&) = delete;

    /// Solves for x in place of f. With alpha = 0 and zero gradient, x has an arbitrary mean.
    void solve(double* first) const;

    std::size_t bytes() const { return pivots_.size() * sizeof(double); }

 private:
    void factorise(Condition condition, double alpha, double beta_over_h2);

    Rows rows_;
    fftw_plan there_, back_;
    double scale_;  // factor of f: normalisation of the transform, and off-diagonal
    // Inverse pivots of the elimination, the modes of a row contiguous.
    std::vector<double> pivots_;
};

}  // namespace turbidite::array_code
