// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Many small symmetric positive definite matrices with a profile, factorised as L L^T: row i is
// zero left of column first(i), and so is L's. Rows of all matrices lie one after the other in one
// array, whose memory is kept. Valid C++17.
#pragma once

#include <cstddef>
#include <vector>

namespace turbidite {

class ProfileCholesky {
 public:
    /// Forgets all matrices.
    void clear();

    /// Begins a matrix; returns its number. Rows follow by add_row.
    int begin_matrix();

    /// Next row of the matrix begun last, from column `first` to the diagonal:
    /// returns its row - first + 1 entries, to be filled in before the next call.
    double* add_row(int first);

    /// Factorises the matrix begun last; false when it is not positive definite to rounding.
    bool factorise();

    /// x <- (L L^T)^-1 x for 1, 2 or 3 right-hand sides, values of one row side by side.
    template <int columns>
    void solve(int matrix, double* x) const;

    int size(int matrix) const { return begin_[matrix + 1] - begin_[matrix]; }

 private:
    std::vector<int> begin_{0};          // first row of each matrix
    std::vector<int> first_;             // of each row: column of its first entry
    std::vector<std::ptrdiff_t> place_;  // of each row: where its column 0 is or would be
    std::vector<double> values_;
    std::vector<double> inverse_;  // of each row: 1/L_ii
};

}  // namespace turbidite
