// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/plane/profile_cholesky.hpp"

#include <algorithm>
#include <cmath>

namespace turbidite {
namespace {

/// A pivot below this fraction of its diagonal entry is zero to rounding.
constexpr double least_pivot = 1e-13;

}  // namespace

void ProfileCholesky::clear() {
    begin_.assign(1, 0);
    first_.clear();
    place_.clear();
    values_.clear();
    inverse_.clear();
}

int ProfileCholesky::begin_matrix() {
    begin_.push_back(begin_.back());
    return static_cast<int>(begin_.size()) - 2;
}

double* ProfileCholesky::add_row(int first) {
    const int row = begin_.back()++ - begin_[begin_.size() - 2];
    first_.push_back(first);
    // So that values_[place_ + k] is the entry of column k, whatever the first one is.
    place_.push_back(static_cast<std::ptrdiff_t>(values_.size()) - first);
    inverse_.push_back(0.0);
    values_.resize(values_.size() + row - first + 1, 0.0);
    return values_.data() + values_.size() - (row - first + 1);
}

bool ProfileCholesky::factorise() {
    // In place: rows before i, and row i to the left of j, are L's already.
    const int begin = begin_[begin_.size() - 2], rows = begin_.back() - begin;
    for (int i = 0; i < rows; ++i) {
        double* row = values_.data() + place_[begin + i];
        const int first = first_[begin + i];
        for (int j = first; j < i; ++j) {
            const double* other = values_.data() + place_[begin + j];
            double sum = row[j];
            // Left of its profile a row is zero, of L as of A.
            for (int k = std::max(first, first_[begin + j]); k < j; ++k) sum -= row[k] * other[k];
            row[j] = sum * inverse_[begin + j];  // L_ij = (A_ij - sum_k L_ik L_jk)/L_jj
        }
        double pivot = row[i];
        for (int k = first; k < i; ++k) pivot -= row[k] * row[k];
        // L_ii^2 = A_ii - sum_k L_ik^2; written so that NaN is refused too.
        if (!(pivot > least_pivot * row[i])) return false;
        // Kept, since every solve divides by it twice.
        inverse_[begin + i] = 1.0 / std::sqrt(pivot);
        row[i] = std::sqrt(pivot);
    }
    return true;
}

template <int columns>
void ProfileCholesky::solve(int matrix, double* x) const {
    const int begin = begin_[matrix], rows = size(matrix);
    for (int i = 0; i < rows; ++i) {  // L y = x
        const double* row = values_.data() + place_[begin + i];
        double at[columns];
        for (int c = 0; c < columns; ++c) at[c] = x[i * columns + c];
        for (int k = first_[begin + i]; k < i; ++k)
            for (int c = 0; c < columns; ++c) at[c] -= row[k] * x[k * columns + c];
        for (int c = 0; c < columns; ++c) x[i * columns + c] = at[c] * inverse_[begin + i];
    }
    for (int i = rows - 1; i >= 0; --i) {  // L^T x = y
        const double* row = values_.data() + place_[begin + i];
        double at[columns];
        for (int c = 0; c < columns; ++c) at[c] = x[i * columns + c] *= inverse_[begin + i];
        for (int k = first_[begin + i]; k < i; ++k)
            for (int c = 0; c < columns; ++c) x[k * columns + c] -= row[k] * at[c];
    }
}

template void ProfileCholesky::solve<1>(int, double*) const;
template void ProfileCholesky::solve<2>(int, double*) const;
template void ProfileCholesky::solve<3>(int, double*) const;

}  // namespace turbidite
