// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Cholesky factors L L^T of many small symmetric positive definite matrices with a profile: row i
// is zero to the left of column first(i), and so is that row of L. The rows of all matrices are
// stored contiguously, in memory that is reused. Valid C++17.
#pragma once

#include <cstddef>
#include <vector>

namespace turbidite {

class ProfileCholesky {
 public:
    /// Removes all matrices.
    void clear();

    /// Begins a matrix and returns its index; its rows follow by add_row.
    int begin_matrix();

    /// Adds a row to the matrix begun last, from column `first` to the diagonal. Returns its row -
    /// first + 1 entries, to be filled in before the next call.
    double* add_row(int first);

    /// Factorises the matrix begun last; false if it is not positive definite to rounding.
    bool factorise();

    /// x <- (L L^T)^-1 x for 1, 2 or 3 right-hand sides; the values of a row are contiguous.
    template <int columns>
    void solve(int matrix, double* x) const;

    int size(int matrix) const { return begin_[matrix + 1] - begin_[matrix]; }

 private:
    std::vector<int> begin_{0};          // first row of each matrix
    std::vector<int> first_;             // of each row: column of its first entry
    std::vector<std::ptrdiff_t> place_;  // of each row: offset of its (possibly absent) column 0
    std::vector<double> values_;
    std::vector<double> inverse_;  // of each row: 1/L_ii
};

}  // namespace turbidite
