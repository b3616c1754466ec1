// SPDX-License-Identifier: GPL-2.0-or-later
//
// (alpha - beta laplacian) x = f on nx x ny square cells with one condition on all four sides: DCT
// or DST of the rows, elimination along y, and back. Row j is transformed while the elimination
// needs it, so that it is read from memory once on the way up and once on the way down.
#pragma once

#include <fftw3.h>

#include <cstddef>
#include <vector>

namespace turbidite::array_code {

/// At the faces of the box: no gradient, or zero.
enum class Condition { neumann, dirichlet };

/// Where the rows of an array are: row j starts at first + j stride, 16-byte aligned.
struct Rows {
    int nx = 0, ny = 0;
    std::ptrdiff_t stride = 0;
};

class BoxSolve {
 public:
    /// alpha [1], beta [m2]; spacing of the cells [m]. `first` is used to plan and overwritten.
    BoxSolve(const Rows& rows, double spacing, Condition condition, double alpha, double beta,
             double* first);
    ~BoxSolve();
    BoxSolve(const BoxSolve&) = delete;
    BoxSolve& operator=(const BoxSolve&) = delete;

    /// From f to x, in place. With alpha = 0 and no gradient, x has an arbitrary mean.
    void solve(double* first) const;

    std::size_t bytes() const { return pivots_.size() * sizeof(double); }

 private:
    void factorise(Condition condition, double alpha, double beta_over_h2);

    Rows rows_;
    fftw_plan there_, back_;
    double scale_;                // of f: transform's normalisation and the off-diagonal
    std::vector<double> pivots_;  // one over the pivots of the elimination, modes side by side
};

}  // namespace turbidite::array_code
